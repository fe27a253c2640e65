// SPDX-License-Identifier: GPL-3.0-or-later
#include "detail/csr.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

using Rows = std::vector<std::vector<int>>;

Rows rows_of(const Csr<int>& csr) {
  Rows rows;
  for (std::size_t row = 0; row < csr.row_count(); ++row) {
    const std::span<const int> items = csr[static_cast<std::int32_t>(row)];
    rows.emplace_back(items.begin(), items.end());
  }
  return rows;
}

Csr<int> csr_of(const Rows& rows) {
  Csr<int> csr;
  for (const std::vector<int>& row : rows) {
    for (const int item : row) csr.push(item);
    csr.end_row();
  }
  return csr;
}

TEST(Csr, HasNoRowsAtFirst) { EXPECT_EQ(Csr<int>().row_count(), 0U); }

TEST(Csr, KeepsTheOrderOfItemsWithinARow) {
  const Csr<int> csr(3, std::vector<std::pair<std::int32_t, int>>{{2, 7}, {0, 5}, {2, 6}, {2, 7}});
  EXPECT_EQ(rows_of(csr), (Rows{{5}, {}, {7, 6, 7}}));
}

TEST(Csr, FillsRowsOneAfterTheOther) {
  const Csr<int> csr = csr_of({{1, 2}, {}, {3}});
  EXPECT_EQ(rows_of(csr), (Rows{{1, 2}, {}, {3}}));
  EXPECT_EQ(csr.items(), (std::vector{1, 2, 3}));
}

TEST(Csr, FillsSomeRowsAnew) {
  const Csr<int> csr = csr_of({{1, 2}, {3}, {}, {4}});
  const std::vector<std::int32_t> rows = {0, 2};
  const Csr<int> changed = csr.with_rows(4, rows, [](std::int32_t row, const auto& add) {
    if (row == 0) return;
    add(8);
    add(9);
  });
  EXPECT_EQ(rows_of(changed), (Rows{{}, {3}, {8, 9}, {4}}));
  EXPECT_EQ(rows_of(csr), (Rows{{1, 2}, {3}, {}, {4}})) << "the former one has changed";
}

TEST(Csr, AddsAndDropsRows) {
  const Csr<int> csr = csr_of({{1}, {2}});
  EXPECT_EQ(rows_of(csr.with_rows(4, {}, [](std::int32_t, const auto&) {})), (Rows{{1}, {2}, {}, {}}));
  EXPECT_EQ(rows_of(csr.with_rows(1, {}, [](std::int32_t, const auto&) {})), (Rows{{1}}));
  const std::vector<std::int32_t> added = {3};
  EXPECT_EQ(rows_of(csr.with_rows(4, added, [](std::int32_t, const auto& add) { add(5); })), (Rows{{1}, {2}, {}, {5}}));
}

TEST(Csr, ChangesRandomRowsAsLoneVectorsWould) {
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  Rows rows;
  for (int round = 0; round < 200; ++round) {
    const Csr<int> csr = csr_of(rows);
    rows.resize(below(20));
    std::vector<std::int32_t> changed;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (below(3) > 0) continue;
      changed.push_back(static_cast<std::int32_t>(row));
      rows[row].assign(below(4), round);
    }
    const Csr<int> after = csr.with_rows(rows.size(), changed, [&](std::int32_t row, const auto& add) {
      for (const int item : rows[static_cast<std::size_t>(row)]) add(item);
    });
    EXPECT_EQ(rows_of(after), rows);
  }
}

}  // namespace
}  // namespace seamwire
