#include "program/temporary_files.hpp"

#include <array>
#include <atomic>
#include <cstdio>
#include <utility>

#ifndef _WIN32
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

// A handler can read no container that is being changed, but it can read these.
using Name = std::filesystem::path::value_type;
std::array<std::atomic<Name*>, kMaxNoted> noted{};
std::atomic<bool> is_ending = false;

} // namespace

NotedTemporary::NotedTemporary(const std::filesystem::path& path) {
    const auto& text = path.native();
    Name* const name = new Name[text.size() + 1];
    name[text.copy(name, text.size())] = 0;
    for (std::size_t i = 0; i < noted.size(); ++i) {
        Name* free = nullptr;
        if (noted[i].compare_exchange_strong(free, name)) {
            slot_ = static_cast<int>(i);
            return;
        }
    }
    delete[] name;
}

NotedTemporary::~NotedTemporary() {
    if (slot_ >= 0) {
        const Name* const name = noted[static_cast<std::size_t>(slot_)].exchange(nullptr);
        if (!is_ending) { // A handler on another thread may read it otherwise.
            delete[] name;
        }
    }
}

NotedTemporary::NotedTemporary(NotedTemporary&& other) noexcept
    : slot_(std::exchange(other.slot_, -1)) {}

NotedTemporary& NotedTemporary::operator=(NotedTemporary&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

void remove_noted_temporaries() noexcept {
    is_ending = true;
    for (std::atomic<Name*>& slot : noted) {
        if (const Name* const name = slot.load(); name != nullptr) {
#ifdef _WIN32
            _wremove(name);
#else
            unlink(name);
#endif
        }
    }
}

} // namespace geodisk::tools
