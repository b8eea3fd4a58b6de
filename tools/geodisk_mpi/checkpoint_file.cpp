#include "checkpoint_file.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <geodisk/exchange.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/params.hpp>
#include <geodisk/version.hpp>

#include "files/input_file.hpp"
#include "files/output/output_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kProgram = "geodisk checkpoint ";
constexpr std::string_view kFirstLine =
    "geodisk checkpoint 2, version " GEODISK_VERSION_STRING "\n";

/// FNV-1a with 64 bits, over words of eight bytes.
class Digest {
  public:
    void add(std::uint64_t word) {
        hash_ = (hash_ ^ word) * 0x100000001b3;
        hash_ ^= hash_ >> 32; // High bits of a word reach the low ones.
    }
    void add_bytes(std::span<const std::byte> bytes) {
        add(bytes.size());
        while (!bytes.empty()) {
            std::uint64_t word = 0;
            const std::size_t count = std::min(bytes.size(), sizeof word);
            std::memcpy(&word, bytes.data(), count);
            add(word);
            bytes = bytes.subspan(count);
        }
    }
    template <class T, std::size_t kExtent>
    void add_all(std::span<const T, kExtent> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add_bytes(std::as_bytes(values));
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::uint64_t digest_of(std::string_view bytes) {
    Digest digest;
    digest.add_all(std::span(bytes));
    return digest.value();
}

[[noreturn]] void refuse(const Path& path, const std::string& why) {
    fail_input(path, why + "; remove it to begin again");
}

} // namespace

std::uint64_t job_digest(const JobFrame& frame, const SampleParams& params) {
    Digest options;
    options.add_bytes(to_bytes(frame));
    for_each_number(
        params, [&](const char*, const auto& number) { options.add_all(std::span(&number, 1)); });
    options.add_all(params.face_keys);
    options.add_all(params.existing);
    options.add_all(params.avoid);
    return options.value();
}

void write_checkpoint(const Path& path, const JobDigests& job, const Checkpoint& checkpoint) {
    MessageWriter message;
    for (const char c : kFirstLine) {
        message.put(c);
    }
    message.put(job);
    message.put(checkpoint.first_stage);
    message.put(checkpoint.candidates);
    message.put_all(checkpoint.samples);
    const Bytes bytes = message.take();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::uint64_t digest = digest_of(text);
    AtomicFile file(path);
    file.write(text);
    file.write({reinterpret_cast<const char*>(&digest), sizeof digest});
    file.commit();
}

Checkpoint read_checkpoint(const Path& path, const JobDigests& job) {
    const std::string text = read_file(path);
    const std::string_view all = text;
    if (!all.starts_with(kProgram)) {
        refuse(path, "is no checkpoint of geodisk_mpi, or damaged");
    }
    std::uint64_t digest = 0;
    const std::string_view body = all.substr(0, all.size() - sizeof digest);
    std::memcpy(&digest, all.data() + body.size(), sizeof digest);
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION // Fuzzers are to get past the digest.
    if (digest != digest_of(body)) {
        refuse(path, "is damaged");
    }
#endif
    if (!body.starts_with(kFirstLine)) {
        refuse(path, "was written by another version of geodisk_mpi");
    }
    MessageReader message(std::as_bytes(std::span(body.substr(kFirstLine.size()))));
    JobDigests found;
    Checkpoint checkpoint;
    message.get(found);
    message.get(checkpoint.first_stage);
    message.get(checkpoint.candidates);
    message.get_all(checkpoint.samples);
    if (!message.is_complete()) {
        refuse(path, "is damaged");
    }
    if (found.mesh != job.mesh) {
        refuse(path, "is of another mesh, or of other radii or another mask");
    }
    if (found.options != job.options) {
        refuse(path, "is of a run with other options");
    }
    return checkpoint;
}

} // namespace geodisk::tools
