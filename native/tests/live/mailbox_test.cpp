// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/mailbox.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

using Box = Mailbox<int, int>;

std::shared_ptr<const int> number(int value) { return std::make_shared<const int>(value); }

/// A mailbox with what it needs.
struct Post {
  EventCount events;
  Box box{events};
};

TEST(Mailbox, WithoutARequestThereIsNothingToDo) {
  Post post;
  EXPECT_FALSE(post.box.take());
  EXPECT_TRUE(post.box.is_finished());
  EXPECT_EQ(post.box.newest(), nullptr);
  EXPECT_EQ(post.box.read().answer, nullptr);
}

TEST(Mailbox, OfRequestsTheNewestIsAnsweredOnce) {
  Post post;
  post.box.post(1);
  post.box.post(2);
  const auto job = post.box.take();
  ASSERT_TRUE(job);
  EXPECT_EQ(*job->request, 2);
  EXPECT_FALSE(post.box.is_finished());
  EXPECT_FALSE(post.box.read().is_newest);
  post.box.answer(*job, [] { return number(20); });
  EXPECT_TRUE(post.box.is_finished());
  EXPECT_TRUE(post.box.read().is_newest);
  EXPECT_TRUE(post.box.read().answers(2));
  EXPECT_FALSE(post.box.read().answers(1)) << "which another thread may ask for";
  EXPECT_EQ(*post.box.read().answer, 20);
  EXPECT_FALSE(post.box.take());
}

TEST(Mailbox, ANewerRequestStopsTheJobAndItsAnswerIsNotKept) {
  Post post;
  post.box.post(1);
  const auto job = post.box.take();
  EXPECT_FALSE(job->stop.stop_requested());
  post.box.post(2);
  EXPECT_TRUE(job->stop.stop_requested());
  post.box.answer(*job, [] { return number(10); });
  post.box.show(*job, number(11));
  EXPECT_EQ(post.box.read().answer, nullptr);
  EXPECT_EQ(*post.box.take()->request, 2);
}

TEST(Mailbox, ANewerRequestMayLetTheJobGoOn) {
  Post post;
  post.box.post(1);
  const auto job = post.box.take();
  post.box.post(2, Box::Former::kDrop, Box::Running::kGoOn);
  EXPECT_FALSE(job->stop.stop_requested());
}

TEST(Mailbox, AnAnswerStaysUntilTheNextOneOnlyIfARequestKeepsIt) {
  Post post;
  post.box.post(1);
  post.box.answer(*post.box.take(), [] { return number(10); });
  post.box.post(2, Box::Former::kKeep);
  EXPECT_EQ(*post.box.read().answer, 10);
  EXPECT_FALSE(post.box.read().is_newest);
  post.box.post(3);
  EXPECT_EQ(post.box.read().answer, nullptr);
}

TEST(Mailbox, AnAnswerThatIsShownEarlyIsNewestButNotFinished) {
  Post post;
  post.box.post(1);
  const auto job = post.box.take();
  post.box.show(*job, number(9));
  EXPECT_EQ(*post.box.read().answer, 9);
  EXPECT_TRUE(post.box.read().is_newest);
  EXPECT_FALSE(post.box.read().is_finished);
}

TEST(Mailbox, AnInterruptedJobIsTakenAgain) {
  Post post;
  post.box.post(1);
  const auto job = post.box.take();
  post.box.interrupt();
  EXPECT_TRUE(job->stop.stop_requested());
  post.box.answer(*job, []() -> std::shared_ptr<const int> { throw Cancelled(); });
  EXPECT_FALSE(post.box.is_finished());
  const auto again = post.box.take();
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->stop.stop_requested());
  EXPECT_EQ(*again->request, 1);
}

TEST(Mailbox, AfterItIsClosedAJobIsStoppedAtOnce) {
  Post post;
  post.box.close();
  post.box.post(1);
  EXPECT_TRUE(post.box.take()->stop.stop_requested());
}

TEST(Mailbox, WithdrawingAsksForNothingAndForgetsTheAnswerAndTheError) {
  Post post;
  post.box.post(1);
  post.box.answer(*post.box.take(), [] { return number(10); });
  post.box.withdraw();
  EXPECT_EQ(post.box.newest(), nullptr);
  EXPECT_EQ(post.box.read().answer, nullptr);
  EXPECT_FALSE(post.box.take());
}

TEST(Mailbox, AnErrorAnswersTheRequestUntilTheNextOne) {
  Post post;
  post.box.post(1);
  post.box.answer(*post.box.take(), []() -> std::shared_ptr<const int> { throw std::runtime_error("why"); });
  EXPECT_TRUE(post.box.is_finished());
  ASSERT_TRUE(post.box.error());
  EXPECT_THROW(std::rethrow_exception(post.box.error()), std::runtime_error);
  EXPECT_EQ(post.box.read().answer, nullptr);
  post.box.post(2);
  EXPECT_FALSE(post.box.error());
}

TEST(Mailbox, WhatIsReplacedIsLeftForTheWorkerToFree) {
  Post post;
  post.box.post(1);
  const auto answer = number(10);
  const std::weak_ptr<const int> request = post.box.newest();
  post.box.answer(*post.box.take(), [&] { return answer; });
  post.box.post(2);
  EXPECT_EQ(answer.use_count(), 2) << "in the discards still";
  EXPECT_FALSE(request.expired());
  EXPECT_EQ(post.events.take_discards().size(), 2U);
  EXPECT_EQ(answer.use_count(), 1);
  EXPECT_TRUE(request.expired());
}

TEST(Mailbox, AnAnswerThatIsGivenBackIsFreedByTheWorkerIfItWasReplaced) {
  Post post;
  post.box.post(1);
  post.box.answer(*post.box.take(), [] { return number(10); });
  std::shared_ptr<const int> read = post.box.read().answer;
  post.box.give_back(read);
  EXPECT_TRUE(post.events.take_discards().empty()) << "the mailbox has it";
  post.box.post(2);
  post.events.take_discards();
  post.box.give_back(std::move(read));
  EXPECT_EQ(post.events.take_discards().size(), 1U);
}

TEST(Mailbox, ManyRequestsToABusyThreadEndWithTheAnswerToTheLast) {
  Post post;
  std::atomic<bool> is_quitting = false;
  std::atomic<int> answered = 0, stopped = 0;
  std::jthread worker([&] {
    while (!is_quitting) {
      const std::uint64_t seen = post.events.count();
      if (!post.events.take_discards().empty()) continue;
      const auto job = post.box.take();
      if (!job) {
        post.events.wait_beyond(seen);
        continue;
      }
      post.box.answer(*job, [&] {
        for (int i = 0; i < 1000; ++i) {
          if (job->stop.stop_requested()) {
            ++stopped;
            throw Cancelled();
          }
          if (i % 100 == 0) post.box.show(*job, number(-*job->request));
        }
        ++answered;
        return number(10 * *job->request);
      });
    }
  });
  for (int i = 1; i <= 2000; ++i) {
    post.box.post(i, i % 3 == 0 ? Box::Former::kKeep : Box::Former::kDrop);
    if (i % 7 == 0) post.box.interrupt();
    const Box::Reading now = post.box.read();
    if (now.is_newest) {
      EXPECT_EQ(*now.answer, now.is_finished ? 10 * i : -i);
    }
    if (now.answer) post.box.give_back(now.answer);
  }
  while (!post.box.is_finished()) {
    const std::uint64_t seen = post.events.count();
    if (!post.box.is_finished()) post.events.wait_beyond(seen);
  }
  EXPECT_EQ(*post.box.read().answer, 20000);
  EXPECT_GE(answered, 1);
  is_quitting = true;
  post.events.add();
}

TEST(EventCount, AnEventBetweenLookingAndWaitingIsNotMissed) {
  EventCount events;
  const std::uint64_t seen = events.count();
  events.add();
  EXPECT_TRUE(events.wait_beyond(seen));
}

TEST(EventCount, WaitsNoLongerThanTheDeadline) {
  const EventCount events;
  EXPECT_FALSE(events.wait_beyond(events.count(), deadline_after(0.001)));
  EXPECT_FALSE(events.wait_beyond(events.count(), deadline_after(-1)));
}

TEST(EventCount, WakesEveryThreadThatWaits) {
  EventCount events;
  std::atomic<int> woken = 0;
  {
    std::vector<std::jthread> threads;
    const std::uint64_t seen = events.count();
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        events.wait_beyond(seen);
        ++woken;
      });
    }
    EXPECT_EQ(woken, 0);
    events.add();
  }
  EXPECT_EQ(woken, 4);
}

}  // namespace
}  // namespace seamwire
