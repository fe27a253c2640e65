// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seamwire::detail {

/// Reads a decimal number from the whole of a word, without regard to the locale. Returns nullopt for anything else,
/// such as "1,5" or "12a". Infinity and nan are numbers here.
std::optional<double> number_from(std::string_view word);

/// Reads an integer from the whole of a word.
std::optional<std::int64_t> integer_from(std::string_view word);

/// Appends the shortest text that number_from() reads as this number.
void append_number(std::string& text, double number);

/// Whether a text has comments after #, and lines that a backslash at their end joins with the next, besides words.
enum class TextSyntax { kWords, kComments, kCommentsAndJoinedLines };

/// The lines of a text as words.
class TextLines {
 public:
  /// `name` is that of the file in messages.
  TextLines(std::string name, std::string_view text, TextSyntax syntax)
      : name_(std::move(name)), rest_(text), syntax_(syntax) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // UTF-8's byte order mark
  }

  /// Moves to the next line that has words. Returns whether there is one.
  bool next();

  /// The words of this line.
  const std::vector<std::string_view>& words() const { return words_; }

  /// What follows this line.
  std::string_view rest() const { return rest_; }

  /// The numbers of this line's words from the first on. Throws FileError where one is no finite number, or there are
  /// less than `least`.
  const std::vector<double>& numbers(std::size_t first, std::size_t least);

  /// A word of this line as an integer. Throws FileError if it is not one.
  std::int64_t integer(std::size_t word) const;

  /// Throws FileError: "NAME, line 12: WHAT".
  [[noreturn]] void fail(const std::string& what) const;

  /// Throws FileError if next() has no line: "NAME: the file ends before WHAT".
  void need(const std::string& what);

 private:
  std::string name_;
  std::string_view rest_;
  TextSyntax syntax_;
  std::string joined_;  ///< a line made of several
  std::vector<std::string_view> words_;
  std::vector<double> numbers_;
  int number_ = 0;       ///< of the line, from 1
  int next_number_ = 1;  ///< of the line after
};

}  // namespace seamwire::detail
