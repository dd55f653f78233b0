#include "output/series.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "options/error.hpp"
#include "output/h5.hpp"

namespace hg {

namespace {
constexpr const char *kMark = "<!-- step ";
}

TimeSeries::TimeSeries(MPI_Comm comm, std::string path, std::string head, std::string tail)
    : comm_(comm), path_(std::move(path)), head_(std::move(head)), tail_(std::move(tail)) {}

void TimeSeries::add(PetscInt step, const std::string &block) {
  while (!blocks_.empty() && blocks_.back().step >= step) blocks_.pop_back();
  char mark[64];
  std::snprintf(mark, sizeof mark, "%s%" PetscInt_FMT " -->\n", kMark, step);
  blocks_.push_back({step, mark + block});
  std::string text = head_;
  for (const Block &b : blocks_) text += b.text;
  write_text(comm_, path_, text + tail_);
}

void TimeSeries::resume(PetscInt last_step) {
  int rank;
  MPI_Comm_rank(comm_, &rank);
  std::string error;
  blocks_.clear();
  if (rank == 0 && std::filesystem::exists(path_)) {  // the others write nothing, so they need no blocks
    std::ifstream in(path_);
    std::stringstream buffer;
    buffer << in.rdbuf();
    const std::string text = buffer.str();
    const std::size_t end = text.rfind(tail_);
    if (!in || text.compare(0, head_.size(), head_) != 0 || end == std::string::npos) {
      error = "cannot go on with " + path_ + ": it is not a list of outputs of this program; move it away";
    } else {
      for (std::size_t at = text.find(kMark); at < end;) {
        const std::size_t next = std::min(text.find(kMark, at + 1), end);
        const long long step = std::atoll(text.c_str() + at + std::char_traits<char>::length(kMark));
        if (step <= last_step) blocks_.push_back({static_cast<PetscInt>(step), text.substr(at, next - at)});
        at = next;
      }
    }
  }
  throw_together(comm_, error);
}

std::string numbered(const std::string &prefix, PetscInt step, const std::string &extension) {
  char number[32];
  std::snprintf(number, sizeof number, "-%06" PetscInt_FMT, step);
  return prefix + number + extension;
}

std::string file_name(const std::string &path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace hg
