// SPDX-License-Identifier: GPL-3.0-or-later
#include "files/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "seamwire/files/mesh_file.hpp"

#ifndef __cpp_lib_to_chars
// Without from_chars() for floating point, as in libc++.
#include <array>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#ifdef __APPLE__
#include <xlocale.h>
#endif
#endif

namespace seamwire::detail {
namespace {

/// Whether a line of an OBJ file is a vertex or a face. Names of files may end with a backslash.
bool can_be_joined(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  return line.substr(begin, 2) == "v " || line.substr(begin, 2) == "f ";
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

#ifndef __cpp_lib_to_chars
double parse(const char* text, char** end) {
#ifdef _WIN32
  static const _locale_t kClassic = _create_locale(LC_ALL, "C");
  return _strtod_l(text, end, kClassic);
#else
  static const locale_t kClassic = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text, end, kClassic);
#endif
}
#endif

}  // namespace

std::optional<double> number_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.starts_with('+')) return std::nullopt;
#ifdef __cpp_lib_to_chars
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc{}) return number;
  if (error != std::errc::result_out_of_range) return std::nullopt;
  // Too small, or too large: the exponent tells.
  const std::size_t e = word.find_first_of("eE");
  return e != std::string_view::npos && word.substr(e).find('-') != std::string_view::npos ? 0.0 : HUGE_VAL;
#else
  // These formats have no hexadecimal numbers.
  if (word.find_first_of("xX") != std::string_view::npos) return std::nullopt;
  const std::string own(word);
  char* end = nullptr;
  const double number = parse(own.c_str(), &end);
  if (end != own.c_str() + own.size()) return std::nullopt;
  return number;
#endif
}

std::optional<std::int64_t> integer_from(std::string_view word) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

void append_number(std::string& text, double number) {
#ifdef __cpp_lib_to_chars
  char digits[32];
  text.append(std::begin(digits), std::to_chars(std::begin(digits), std::end(digits), number).ptr);
#else
  std::array<char, 40> digits{};
  std::string own;
  for (const int precision : {15, 16, 17}) {
    std::snprintf(digits.data(), digits.size(), "%.*g", precision, number);
    own = digits.data();
    // The locale's decimal point may have several bytes.
    const std::size_t point = own.find_first_not_of("0123456789+-einfa");
    if (point != std::string::npos) own.replace(point, own.find_first_of("0123456789", point) - point, ".");
    if (number_from(own) == number) break;
  }
  text += own;
#endif
}

bool TextLines::next() {
  while (!rest_.empty()) {
    number_ = next_number_;
    const auto take = [&] {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(end);
      rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
      ++next_number_;
      while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
      return syntax_ == TextSyntax::kWords ? line : line.substr(0, line.find('#'));
    };
    std::string_view line = take();
    if (syntax_ == TextSyntax::kCommentsAndJoinedLines && line.ends_with('\\') && can_be_joined(line)) {
      joined_.clear();
      while (line.ends_with('\\') && !rest_.empty()) {
        joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = take();
      }
      joined_ += line;
      line = joined_;
    }
    words_.clear();
    for (std::size_t i = 0; i < line.size();) {
      if (is_blank(line[i])) {
        ++i;
        continue;
      }
      const std::size_t begin = i;
      while (i < line.size() && !is_blank(line[i])) ++i;
      words_.push_back(line.substr(begin, i - begin));
    }
    if (!words_.empty()) return true;
  }
  return false;
}

const std::vector<double>& TextLines::numbers(std::size_t first, std::size_t least) {
  numbers_.clear();
  for (std::size_t i = first; i < words_.size(); ++i) {
    const std::optional<double> number = number_from(words_[i]);
    if (!number) fail("'" + std::string(words_[i]) + "' is not a number");
    if (!std::isfinite(*number)) fail("'" + std::string(words_[i]) + "' is not finite");
    numbers_.push_back(*number);
  }
  if (numbers_.size() < least) {
    fail("there are " + std::to_string(numbers_.size()) + " numbers instead of " + std::to_string(least));
  }
  return numbers_;
}

std::int64_t TextLines::integer(std::size_t word) const {
  if (word >= words_.size()) fail("a number is missing at the end");
  const std::optional<std::int64_t> number = integer_from(words_[word]);
  if (!number) fail("'" + std::string(words_[word]) + "' is not an integer");
  return *number;
}

void TextLines::fail(const std::string& what) const {
  throw FileError(name_ + ", line " + std::to_string(number_) + ": " + what);
}

void TextLines::need(const std::string& what) {
  if (!next()) throw FileError(name_ + ": the file ends before " + what);
}

}  // namespace seamwire::detail
