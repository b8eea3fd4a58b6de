#include "geodisk/outputs/progress.hpp"

#include <algorithm>
#include <cstdio>

#include "program/safe_text.hpp"
#include "program/terminal.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kColumns = 79; // A line that wraps cannot be cleared again.
constexpr std::size_t kBarColumns = 30;

} // namespace

ProgressLine::ProgressLine(bool quiet) : enabled_(!quiet && stderr_is_terminal()) {}

ProgressLine::~ProgressLine() {
    clear();
}

void ProgressLine::begin_stage(std::string_view name) {
    if (enabled_) {
        stage_ = name;
        stage_start_ = Clock::now();
        draw(stage_ + " ...");
    }
}

void ProgressLine::update(double fraction, std::string_view detail) {
    const Clock::time_point now = Clock::now();
    if (!enabled_ || now - stage_start_ < std::chrono::milliseconds(500) ||
        now - last_update_ < std::chrono::milliseconds(100)) {
        return;
    }
    last_update_ = now;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(kBarColumns));
    const std::string percent = std::to_string(static_cast<int>(100 * fraction));
    std::string text =
        stage_ + "  [" + std::string(filled, '#') + std::string(kBarColumns - filled, '.') + "] ";
    text.append(3 - std::min<std::size_t>(percent.size(), 3), ' ');
    text += percent + " %  ";
    text += detail;
    draw(text);
}

void ProgressLine::clear() {
    if (drawn_ > 0) {
        draw("");
        std::fputc('\r', stderr);
        std::fflush(stderr);
    }
}

void ProgressLine::draw(std::string_view text) {
    std::string line(1, '\r');
    line += one_line(text.substr(0, kColumns));
    const std::size_t columns = line.size() - 1;
    if (columns < drawn_) {
        line.append(drawn_ - columns, ' ');
    }
    drawn_ = columns;
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
}

} // namespace geodisk::tools
