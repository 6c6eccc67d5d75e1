#include "apps/text/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>
#include <vector>

#include "apps/text/seconds.h"

namespace luxfit {
namespace {

constexpr int kBarWidth = 20;
constexpr double kBetweenLinesS = 10;
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr char kClearLine[] = "\r\x1b[K";

bool WantsColour(std::FILE* stream) { return IsTerminal(stream) && std::getenv("NO_COLOR") == nullptr; }

// Returns the colour of a line, which its beginning decides.
std::string ColourOf(const std::string& line) {
  static const std::vector<std::pair<std::string, std::string>> colours = {
      {"warning:", "33"}, {"note ", "33"}, {"bad ", "31"}, {"luxfit: ", "31"}, {"good ", "32"}};
  for (const auto& [start, colour] : colours) {
    if (line.rfind(start, 0) == 0) return colour;
  }
  return "";
}

}  // namespace

bool IsTerminal(std::FILE* stream) {
  const char* const term = std::getenv("TERM");
  return isatty(fileno(stream)) != 0 && term != nullptr && std::string(term) != "dumb";
}

std::string WithColours(const std::string& text) {
  std::string coloured;
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find('\n', start), text.size() - 1);
    const std::string line = text.substr(start, end + 1 - start);
    const std::string colour = ColourOf(line);
    const size_t word = std::min(line.find_first_of(" \n"), line.size());
    coloured +=
        colour.empty() ? line : "\x1b[" + colour + "m" + line.substr(0, word) + "\x1b[0m" + line.substr(word);
    start = end + 1;
  }
  return coloured;
}

void PrintText(const std::string& text) {
  std::fputs((WantsColour(stdout) ? WithColours(text) : text).c_str(), stdout);
}

void PrintError(const std::string& message) {
  const std::string text = "luxfit: " + message + "\n";
  std::fputs((WantsColour(stderr) ? WithColours(text) : text).c_str(), stderr);
}

std::string ProgressText(double share, double elapsed_s) {
  if (!(share > 0)) return fmt::format("{:.1f} s", elapsed_s);
  const double bounded = std::min(share, 1.0);
  const auto filled = static_cast<size_t>(bounded * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '-');
  // It has already taken longer than the last time, so the rest is not known.
  if (share > 1) return fmt::format("[{}]  {:.1f} s", bar, elapsed_s);
  return fmt::format("[{}]  {:.1f} s, {:.1f} s to go", bar, elapsed_s, elapsed_s * (1 - bounded) / bounded);
}

ProgressLine::ProgressLine(std::string text, double expected_s)
    : text_(std::move(text)), expected_s_(expected_s), start_s_(NowS()), said_s_(start_s_) {
  if (!IsTerminal(stderr)) {
    std::fprintf(stderr, "%s\n", text_.c_str());
    is_over_ = true;
    return;
  }
  drawer_ = std::thread([this] {
    while (!is_over_) {
      Draw();
      std::this_thread::sleep_for(kRedraw);
    }
  });
}

void ProgressLine::Draw() {
  const double elapsed_s = NowS() - start_s_;
  const int total = total_, done = done_;
  // All counted parts are done; what still runs was not counted.
  const bool is_counted = total > 0 && done < total;
  const double share =
      is_counted ? static_cast<double>(done) / total : (expected_s_ > 0 ? elapsed_s / expected_s_ : -1);
  const std::lock_guard<std::mutex> lock(said_mutex_);
  std::fprintf(stderr, "%s%s  %s%s", kClearLine, text_.c_str(), said_.c_str(),
               ProgressText(share, elapsed_s).c_str());
}

void ProgressLine::Say(const std::string& words) {
  const std::lock_guard<std::mutex> lock(said_mutex_);
  said_ = words + "  ";
  if (drawer_.joinable() || NowS() - said_s_ < kBetweenLinesS) return;
  said_s_ = NowS();
  std::fprintf(stderr, "%-9s %s\n", "", words.c_str());
}

void ProgressLine::Advance(int total) {
  total_ = total;
  ++done_;
}

void ProgressLine::HandOver() {
  if (!drawer_.joinable()) return;
  is_over_ = true;
  drawer_.join();
  std::fprintf(stderr, "%s%s\n", kClearLine, text_.c_str());
}

ProgressLine::~ProgressLine() {
  if (!drawer_.joinable()) return;
  is_over_ = true;
  drawer_.join();
  std::fprintf(stderr, "%s%s  %.1f s\n", kClearLine, text_.c_str(), NowS() - start_s_);
}

}  // namespace luxfit
