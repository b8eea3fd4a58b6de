#include "files/output/temporary_file.hpp"

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#else
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <geodisk/detail/fnv1a.hpp>

#include "files/descriptor.hpp"

namespace geodisk::tools {
namespace {

/// The name without the number. Short, as that of the target may be as long as names can be.
std::filesystem::path name_for(const std::filesystem::path& target) {
    detail::Fnv1a hash;
    const std::filesystem::path target_name = target.filename();
    for (const auto unit : target_name.native()) {
        hash.add(static_cast<std::uint64_t>(unit));
    }
    return target.parent_path() / ("geodisk-" + detail::hexadecimal(hash.value()) + ".tmp");
}

#ifdef _WIN32
constexpr int kNoFollow = 0;

void remove_if_abandoned(const std::filesystem::path& path) {
    _wremove(path.c_str());
}

/// 0 or an errno value.
int make_empty(const std::filesystem::path& path) {
    const int descriptor = open_alone(path, _O_CREAT | _O_EXCL | _O_WRONLY);
    return descriptor < 0 ? errno : _close(descriptor);
}

bool is_at(int /*descriptor*/, const std::filesystem::path& /*path*/) {
    return true; // Others cannot remove what is open.
}

// An open file has no second name there.
int link_file(const std::filesystem::path& /*from*/, const std::filesystem::path& /*to*/) {
    return ENOSYS;
}
#else
constexpr int kNoFollow = O_NOFOLLOW;

bool is_at(int descriptor, const std::filesystem::path& path) {
    struct stat opened {
    }, named{};
    return fstat(descriptor, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void remove_if_abandoned(const std::filesystem::path& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) {
        return;
    }
    struct stat status {};
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
        flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_at(descriptor, path)) {
        unlink(path.c_str());
    }
    close(descriptor);
}

/// 0 or an errno value.
int make_empty(const std::filesystem::path& path) {
    const int descriptor =
        open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0666);
    return descriptor < 0 ? errno : close(descriptor);
}

int link_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    return link(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}
#endif

/// Whoever holds the lock owns the file.
std::FILE* open_new(const std::filesystem::path& path) {
    const int descriptor = open_alone(path, O_CREAT | O_EXCL | O_WRONLY | kNoFollow);
    if (descriptor < 0) {
        // A locked file was taken for abandoned by another process meanwhile, which removes it.
        errno = errno == EWOULDBLOCK ? EEXIST : errno;
        return nullptr;
    }
    if (!is_at(descriptor, path)) {
        close(descriptor); // And here has removed it.
        errno = EEXIST;
        return nullptr;
    }
    std::FILE* const file = fdopen(descriptor, "wb");
    if (file == nullptr) {
        std::error_code ignored;
        close(descriptor);
        std::filesystem::remove(path, ignored);
    }
    return file;
}

} // namespace

TemporaryFile make_temporary(const std::filesystem::path& target) {
    constexpr int kMaxWriters = 1000; // Of one target at a time.
    const std::filesystem::path name = name_for(target);
    TemporaryFile made;
    for (int number = 0; made.file == nullptr && number < kMaxWriters; ++number) {
        made.path = name;
        made.path += std::to_string(number);
        made.file = open_new(made.path);
        if (made.file == nullptr && errno == EEXIST) {
            remove_if_abandoned(made.path);
            made.file = open_new(made.path);
        }
        if (made.file == nullptr && errno != EEXIST) {
            break;
        }
    }
    return made;
}

int claim_name(const std::filesystem::path& temporary, const std::filesystem::path& target) {
    const int error = link_file(temporary, target);
    return error == 0 || error == EEXIST ? error : make_empty(target);
}

int move_file(const std::filesystem::path& temporary, const std::filesystem::path& target) {
    std::error_code error;
    if (std::filesystem::equivalent(temporary, target, error)) { // By claim_name().
        std::filesystem::remove(temporary, error);
    } else {
        std::filesystem::rename(temporary, target, error);
    }
    return error ? error.default_error_condition().value() : 0;
}

} // namespace geodisk::tools
