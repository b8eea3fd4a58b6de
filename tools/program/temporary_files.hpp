// The temporary files of this process, so that one that is ended by a signal can remove them.
#pragma once

#include <cstddef>
#include <filesystem>

namespace geodisk::tools {

/// Files that are noted at a time.
inline constexpr std::size_t kMaxNoted = 64;

/// Notes a file while it lives, from any thread. More than kMaxNoted are not noted.
class NotedTemporary {
  public:
    NotedTemporary() noexcept = default;
    explicit NotedTemporary(const std::filesystem::path& path);
    ~NotedTemporary();
    NotedTemporary(NotedTemporary&& other) noexcept;
    NotedTemporary& operator=(NotedTemporary&& other) noexcept;

  private:
    int slot_ = -1;
};

/// Removes all that are noted, as the process ends. A signal handler may call it.
void remove_noted_temporaries() noexcept;

} // namespace geodisk::tools
