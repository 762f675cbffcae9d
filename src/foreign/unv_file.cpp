#include "foreign/unv_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <filesystem>

#include "base/error.hpp"
#include "base/plain_file.hpp"
#include "foreign/bulk_cards.hpp"
#include "foreign/cards.hpp"

namespace dygita {

namespace {

constexpr std::string_view bound = "-1";

bool to_whole(std::string_view field, long& value) {
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

}  // namespace

UnvFile::UnvFile(const std::string& file) : file_(file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw InputError(fmt::format("mesh file '{}' does not exist (looked for {})", file,
                                 std::filesystem::absolute(file).lexically_normal().string()));
  text_ = text_of_file(file);
  int line = 0;
  bool is_open = false, has_number = false;
  for (std::string_view rest = text_; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line;
    if (text.ends_with('\r')) text.remove_suffix(1);
    const std::string_view said = without_blanks_around(text);
    if (said == bound) {
      if (is_open && !has_number) throw InputError(fmt::format("{}:{}: a dataset without a number", file_, line));
      is_open = !is_open;
      has_number = false;
    } else if (is_open && !has_number) {
      long number = 0;  // "2414", or "58b" of binary data
      if (!to_whole(said.substr(0, said.find_first_not_of("0123456789")), number))
        throw InputError(fmt::format("{}:{}: the number of a dataset is expected, not '{}'", file_, line, shown(said)));
      datasets_.push_back({number, line, {}});
      has_number = true;
    } else if (is_open) {
      datasets_.back().lines.push_back(text);
    } else if (!said.empty()) {
      throw InputError(
          fmt::format("{}:{}: a line of -1 is expected, which opens a dataset, not '{}'", file_, line, shown(said)));
    }
  }
  if (is_open) throw InputError(fmt::format("{}:{}: the last dataset does not end: the file is cut off", file_, line));
}

void UnvLines::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: dataset {}: {}", file_.file(), line(), dataset_.number, what));
}

std::string_view UnvLines::take(const char* what) {
  if (is_at_end()) fail(fmt::format("{} is expected, not the end of the dataset", what));
  return dataset_.lines[next_++];
}

void UnvLines::split(std::string_view line) {
  fields_.clear();
  constexpr std::string_view blanks = " \t";
  for (size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(blanks, at), line.size());
    fields_.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
}

size_t UnvLines::n_in_next() const {
  if (is_at_end()) return 0;
  UnvLines ahead(*this);
  ahead.split(dataset_.lines[next_]);
  return ahead.fields_.size();
}

const std::vector<long>& UnvLines::wholes(size_t least, const char* what) {
  split(take(what));
  wholes_.clear();
  for (const std::string_view field : fields_) {
    long value = 0;
    if (!to_whole(field, value)) fail(fmt::format("{} is expected, not '{}'", what, shown(field)));
    wholes_.push_back(value);
  }
  if (wholes_.size() < least) fail(fmt::format("{}: {} numbers are expected, not {}", what, least, wholes_.size()));
  return wholes_;
}

const std::vector<double>& UnvLines::reals(size_t least, const char* what) {
  split(take(what));
  reals_.clear();
  for (const std::string_view field : fields_) {
    double value = 0.0;
    if (!nastran_real(field, value)) fail(fmt::format("{} is expected, not '{}'", what, shown(field)));
    reals_.push_back(value);
  }
  if (reals_.size() < least) fail(fmt::format("{}: {} numbers are expected, not {}", what, least, reals_.size()));
  return reals_;
}

}  // namespace dygita
