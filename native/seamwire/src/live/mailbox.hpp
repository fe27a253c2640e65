// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "detail/deadline.hpp"
#include "detail/thread_safety.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {

/// Counts events, so that a thread can wait for the next one. A waiter reads the count first, then looks at what it
/// waits for, and waits for a larger count only if it found nothing. So it misses no event.
///
/// An event may come with objects that take long to free. A worker takes and frees them, so that no caller waits.
class EventCount {
 public:
  std::uint64_t count() const {
    const MutexLock lock(mutex_);
    return count_;
  }
  void add(std::shared_ptr<const void> discarded = nullptr, std::shared_ptr<const void> also_discarded = nullptr) {
    const MutexLock lock(mutex_);
    if (discarded) discards_.push_back(std::move(discarded));
    if (also_discarded) discards_.push_back(std::move(also_discarded));
    ++count_;
    changed_.notify_all();
  }
  /// All discarded objects, for the caller to free.
  std::vector<std::shared_ptr<const void>> take_discards() {
    const MutexLock lock(mutex_);
    return std::exchange(discards_, {});
  }
  /// Waits until the count is larger than `seen`; false if the deadline passes before.
  bool wait_beyond(std::uint64_t seen, const Deadline& deadline = std::nullopt) const {
    MutexLock lock(mutex_);
    while (count_ == seen) {
      if (!wait_once(changed_, lock, deadline)) return count_ != seen;
    }
    return true;
  }

 private:
  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::uint64_t count_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::vector<std::shared_ptr<const void>> discards_ SEAMWIRE_GUARDED_BY(mutex_);
};

/// Requests of one thread to another. Only the newest request counts, and work for an older one is stopped.
///
/// Any thread posts requests and reads answers, and one takes jobs and answers them. None waits in a member.
/// Requests and answers that are replaced are discarded with the events, because freeing them may take long.
template <class Request, class Answer>
class Mailbox {
 public:
  /// The work on one request.
  struct Job {
    std::int64_t number = 0;
    std::shared_ptr<const Request> request;
    std::stop_token stop;  ///< requested once the answer is no longer wanted
  };
  /// The current state of the requests.
  struct Reading {
    std::shared_ptr<const Answer> answer;   ///< the last one that was kept, or null
    std::int64_t number = 0;                ///< of the request that it answers
    bool is_newest = false;                 ///< whether that is the newest request
    bool is_finished = true;                ///< whether the newest request needs no more work
    std::shared_ptr<const Request> newest;  ///< the newest request, or null
    /// Whether `answer` answers this request. If not, another thread may have posted a request meanwhile.
    bool answers(const Request& request) const { return is_newest && *newest == request; }
  };
  enum class Former { kKeep, kDrop };   ///< what a request does with the answer to the one before
  enum class Running { kStop, kGoOn };  ///< what a request does with the running job

  /// `events` counts each change.
  explicit Mailbox(EventCount& events) : events_(events) {}

  /// Asks for an answer in place of the one asked for before.
  void post(Request request, Former former = Former::kDrop, Running running = Running::kStop) {
    replace(std::make_shared<const Request>(std::move(request)), former, running);
  }
  /// Asks for nothing, and forgets the answer.
  void withdraw() { replace(nullptr, Former::kDrop, Running::kStop); }
  /// Stops the running job. Its request stays unanswered, so take() gives it again.
  void interrupt() {
    const MutexLock lock(mutex_);
    stop_.request_stop();
  }
  /// Stops the running job and every later one at its beginning.
  void close() {
    const MutexLock lock(mutex_);
    is_closed_ = true;
    stop_.request_stop();
  }

  std::shared_ptr<const Request> newest() const {
    const MutexLock lock(mutex_);
    return newest_;
  }
  /// The number of the newest request, which grows with each.
  std::int64_t number() const {
    const MutexLock lock(mutex_);
    return number_;
  }
  bool is_finished() const {
    const MutexLock lock(mutex_);
    return finished_ == number_;
  }
  Reading read() const {
    const MutexLock lock(mutex_);
    return {.answer = answer_,
            .number = answer_to_,
            .is_newest = answer_ && answer_to_ == number_,
            .is_finished = finished_ == number_,
            .newest = newest_};
  }
  /// Why the newest request failed; null if it did not.
  std::exception_ptr error() const {
    const MutexLock lock(mutex_);
    return error_;
  }
  /// Gives an answer back that was read, so that the reader is not the one who frees it.
  void give_back(std::shared_ptr<const Answer> answer) {
    if (!answer) return;
    {
      const MutexLock lock(mutex_);
      if (answer == answer_) {
        answer = nullptr;  // the mailbox has it still
        return;
      }
    }
    events_.add(std::move(answer));
  }

  /// The newest request, if it needs work.
  std::optional<Job> take() {
    const MutexLock lock(mutex_);
    if (finished_ == number_) return std::nullopt;
    stop_ = std::stop_source();
    if (is_closed_) stop_.request_stop();
    return Job{.number = number_, .request = newest_, .stop = stop_.get_token()};
  }
  /// Gives an answer before the job has finished.
  void show(const Job& job, std::shared_ptr<const Answer> answer) { show(job.number, std::move(answer)); }
  void show(std::int64_t number, std::shared_ptr<const Answer> answer) {
    keep(number, std::move(answer), nullptr, false);
  }
  /// Does a job: its answer is what make() returns or throws. If that is Cancelled, the request stays unanswered.
  template <class Make>
  void answer(const Job& job, const Make& make) {
    std::shared_ptr<const Answer> made;
    std::exception_ptr error;
    try {
      made = make();
    } catch (const Cancelled&) {
      return;
    } catch (...) {
      error = std::current_exception();
    }
    keep(job.number, std::move(made), std::move(error), true);
  }

 private:
  void replace(std::shared_ptr<const Request> request, Former former, Running running) {
    std::shared_ptr<const Answer> answer;
    {
      const MutexLock lock(mutex_);
      ++number_;
      if (!request) finished_ = number_;
      newest_.swap(request);
      error_ = nullptr;
      if (former == Former::kDrop) answer_.swap(answer);
      if (running == Running::kStop) stop_.request_stop();
    }
    events_.add(std::move(request), std::move(answer));
  }
  void keep(std::int64_t number, std::shared_ptr<const Answer> answer, std::exception_ptr error, bool is_finished) {
    {
      const MutexLock lock(mutex_);
      if (number == number_) {
        if (is_finished) finished_ = number;
        answer_to_ = number;
        answer_.swap(answer);
        error_ = std::move(error);
        if (answer == answer_) answer = nullptr;
      }
    }
    events_.add(std::move(answer));
  }

  EventCount& events_;
  mutable Mutex mutex_;
  std::int64_t number_ SEAMWIRE_GUARDED_BY(mutex_) = 0;     // of the newest request
  std::int64_t finished_ SEAMWIRE_GUARDED_BY(mutex_) = 0;   // the newest request that needs no more work
  std::int64_t answer_to_ SEAMWIRE_GUARDED_BY(mutex_) = 0;  // the request that answer_ is to
  std::shared_ptr<const Request> newest_ SEAMWIRE_GUARDED_BY(mutex_);
  std::shared_ptr<const Answer> answer_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
  std::stop_source stop_ SEAMWIRE_GUARDED_BY(mutex_);  // of the running job
  bool is_closed_ SEAMWIRE_GUARDED_BY(mutex_) = false;
};

}  // namespace seamwire::detail
