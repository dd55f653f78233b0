#include "records.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace hg::test {
namespace {

std::string on_one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
  return text;
}

std::string place_of(const testing::TestInfo &info) {
  std::string area = std::filesystem::path(info.file()).stem().string();
  if (const auto end = area.rfind("_test"); end != std::string::npos) area.resize(end);
  return area + '\t' + info.test_suite_name() + '\t' + info.name();
}

}  // namespace

Recorder::Recorder(const std::string &file) : stream_(file, std::ios::app) {
  if (!stream_) throw std::runtime_error("cannot write the record '" + file + "'");
}

void Recorder::OnTestStart(const testing::TestInfo &info) {
  stream_ << "start\t" << place_of(info) << std::endl;
}

void Recorder::OnTestEnd(const testing::TestInfo &info) {
  const testing::TestResult &result = *info.result();
  std::string message;
  for (int i = 0; i < result.total_part_count(); i++) {
    const testing::TestPartResult &part = result.GetTestPartResult(i);
    if (part.passed()) continue;
    if (!message.empty()) message += " | ";
    if (!part.skipped() && part.file_name() != nullptr) {
      message += std::filesystem::path(part.file_name()).filename().string() + ":" +
                 std::to_string(part.line_number()) + ": ";
    }
    message += part.message();
  }
  stream_ << (result.Failed() ? "failed" : result.Skipped() ? "skipped" : "passed") << '\t' << place_of(info) << '\t'
          << result.elapsed_time() << '\t' << on_one_line(message) << std::endl;
}

std::string filter_of_cases_in(const std::string &file) {
  std::ifstream stream(file);
  std::string filter;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    std::string event, area, suite, name;
    if (!std::getline(fields, event, '\t') || event != "start") continue;
    std::getline(fields, area, '\t') && std::getline(fields, suite, '\t') && std::getline(fields, name, '\t');
    filter += (filter.empty() ? "" : ":") + suite + "." + name;
  }
  return filter;
}

}  // namespace hg::test
