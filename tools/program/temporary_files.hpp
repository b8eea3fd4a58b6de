// The temporary files of this process, so that one that is ended by a signal can remove them.
#pragma once

#include <filesystem>

namespace geodisk::tools {

/// Notes a file while it lives. Room is for 16 at a time; more are not noted.
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
