// A universal file (.unv) as datasets: numbers between lines of -1, and the lines of each.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace dygita {

struct UnvDataset {
  long number;
  int line;  // of the number, from 1
  std::vector<std::string_view> lines;
};

class UnvFile {
 public:
  // Throws InputError: a file missing or unreadable, a dataset that does not end.
  explicit UnvFile(const std::string& file);
  UnvFile(const UnvFile&) = delete;
  UnvFile& operator=(const UnvFile&) = delete;

  const std::string& file() const { return file_; }
  const std::vector<UnvDataset>& datasets() const { return datasets_; }

 private:
  std::string file_, text_;
  std::vector<UnvDataset> datasets_;
};

// The lines of a dataset one after the other, and the numbers in each.
class UnvLines {
 public:
  UnvLines(const UnvFile& file, const UnvDataset& dataset) : file_(file), dataset_(dataset) {}

  bool is_at_end() const { return next_ >= dataset_.lines.size(); }
  int line() const { return dataset_.line + static_cast<int>(next_); }  // of the last one taken
  // `what`: of which there is none where the dataset ends.
  std::string_view take(const char* what);
  // Of the line that follows; at least `least`.
  const std::vector<long>& wholes(size_t least, const char* what);
  const std::vector<double>& reals(size_t least, const char* what);
  size_t n_in_next() const;  // fields in the line that follows
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void split(std::string_view line);

  const UnvFile& file_;
  const UnvDataset& dataset_;
  size_t next_ = 0;
  std::vector<std::string_view> fields_;
  std::vector<long> wholes_;
  std::vector<double> reals_;
};

}  // namespace dygita
