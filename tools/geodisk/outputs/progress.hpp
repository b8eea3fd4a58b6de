// A line on the terminal that tells what is being done and how far it is.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Writes to standard error, and only if that is a terminal. Needs no more of it than a carriage
/// return. The line is gone when the object is.
class ProgressLine {
  public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Begins a stage of unknown length.
    void begin_stage(std::string_view name);

    /// Draws a bar for the stage, at most ten times a second and not in its first half second.
    void update(double fraction, std::string_view detail);

    /// Call before anything else is written.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    void draw(std::string_view text);

    bool enabled_;
    std::string stage_;
    std::size_t drawn_ = 0; ///< Columns on the terminal.
    Clock::time_point stage_start_{};
    Clock::time_point last_update_{};
};

} // namespace geodisk::tools
