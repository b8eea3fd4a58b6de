#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kTriangleMagic = "\xff\xff\xfe", kQuadMagic = "\xff\xff\xff",
                           kNewQuadMagic = "\xff\xff\xfd", kAsciiMagic = "#!ascii";
constexpr bool kSurfaceIsLittle = false; // Numbers begin with their highest byte.
constexpr std::size_t kSurfaceWord = 4, kSurfaceRow = 3 * kSurfaceWord;

/// Bytes behind the magic number: two lines of text, two counts, points and triangles.
PolygonMesh read_triangles(const Path& path, std::string_view bytes,
                           const ReadingProgress& progress) {
    std::size_t at = kTriangleMagic.size();
    for (int line = 0; line < 2; ++line) {
        const std::size_t end = bytes.find('\n', at);
        if (end == bytes.npos) {
            fail_input(path, "byte " + std::to_string(at) +
                                 ": the file ends inside its two lines of text");
        }
        at = end + 1;
    }
    const auto count = [&](const char* what) {
        const std::int32_t value =
            bytes.size() - at < kSurfaceWord
                ? -1
                : value_of_bytes<std::int32_t>(bytes.data() + at, kSurfaceIsLittle);
        if (value < 0) {
            fail_input(path, "byte " + std::to_string(at) + ": no number of " + what);
        }
        at += kSurfaceWord;
        return static_cast<std::size_t>(value);
    };
    const std::size_t vertices = count("vertices"), faces = count("faces");
    if ((bytes.size() - at) / kSurfaceRow < vertices + faces) {
        fail_input(path, "ends after " + grouped(bytes.size()) + " bytes, but " +
                             counted(vertices, "vertex", "vertices") + " and " +
                             counted(faces, "face", "faces") + " end at byte " +
                             grouped(at + (vertices + faces) * kSurfaceRow));
    }
    PolygonMesh mesh;
    mesh.positions.reserve(3 * vertices);
    mesh.corners.reserve(3 * faces);
    mesh.face_ends.reserve(faces);
    for (std::size_t i = 0; i < 3 * vertices; ++i, at += kSurfaceWord) {
        mesh.positions.push_back(value_of_bytes<float>(bytes.data() + at, kSurfaceIsLittle));
        tell(progress, i, at, bytes.size());
    }
    for (std::size_t i = 1; i <= 3 * faces; ++i, at += kSurfaceWord) {
        mesh.corners.push_back(value_of_bytes<std::uint32_t>(bytes.data() + at, kSurfaceIsLittle));
        if (i % 3 == 0) {
            mesh.face_ends.push_back(i);
        }
        tell(progress, i, at, bytes.size());
    }
    return mesh; // Tags that tell of the volume may follow.
}

/// A comment, two counts, and lines of three numbers and a mark.
class FreeSurferText {
  public:
    FreeSurferText(const Path& path, std::string_view text, const ReadingProgress& progress)
        : path_(path), lines_(text, progress), size_(text.size()) {}

    PolygonMesh read() && {
        std::string_view comment;
        lines_.next(comment);
        next_record("the numbers of vertices and faces", 2);
        const auto vertices = number_at<std::uint32_t>(0), faces = number_at<std::uint32_t>(1);
        mesh_.positions.reserve(3 * std::min<std::size_t>(vertices, size_ / 6));
        mesh_.face_ends.reserve(std::min<std::size_t>(faces, size_ / 6));
        for (std::uint32_t i = 0; i < vertices; ++i) {
            next_record("vertex " + std::to_string(i), 3);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::optional<double> value = parse_real(words_[axis]);
                if (!value) {
                    fail(in_quotes(words_[axis]) + " is not a number");
                }
                mesh_.positions.push_back(*value);
            }
            mesh_.names.vertex_lines.push_back(lines_.number());
        }
        for (std::uint32_t i = 0; i < faces; ++i) {
            next_record("face " + std::to_string(i), 3);
            for (std::size_t k = 0; k < 3; ++k) {
                mesh_.corners.push_back(number_at<std::uint32_t>(k));
            }
            mesh_.face_ends.push_back(mesh_.corners.size());
            mesh_.names.face_lines.push_back(lines_.number());
        }
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(lines_.number()) + ": " + message);
    }

    void next_record(const std::string& what, std::size_t size) {
        std::string_view line;
        words_.clear();
        while (words_.empty()) {
            if (!lines_.next(line)) {
                fail_input(path_, "the file ends before " + what);
            }
            if (line.find('\0') != line.npos) {
                fail(lines_.nul_message());
            }
            split_tokens(line, words_);
        }
        if (words_.size() < size) {
            fail("has too few numbers for " + what);
        }
    }

    template <class Integer>
    Integer number_at(std::size_t i) const {
        const auto number = parse_integer<Integer>(words_[i]);
        if (!number) {
            fail(in_quotes(words_[i]) + " is neither a number of elements nor of a vertex");
        }
        return *number;
    }

    const Path& path_;
    TextLines lines_;
    std::size_t size_;
    std::vector<std::string_view> words_;
    PolygonMesh mesh_;
};

} // namespace

bool begins_as_freesurfer(const Path& path) {
    const std::string magic = head_of(path, kTriangleMagic.size());
    return magic == kTriangleMagic || magic == kQuadMagic || magic == kNewQuadMagic;
}

PolygonMesh read_freesurfer(const Path& path, const ReadingProgress& progress) {
    const std::string bytes = read_file(path);
    if (bytes.empty()) {
        fail_input(path, "is empty");
    }
    if (bytes.starts_with(kTriangleMagic)) {
        return read_triangles(path, bytes, progress);
    }
    if (bytes.starts_with(kAsciiMagic)) {
        return FreeSurferText(path, bytes, progress).read();
    }
    if (bytes.starts_with(kQuadMagic) || bytes.starts_with(kNewQuadMagic)) {
        fail_input(path, "is a FreeSurfer file of quads or of values of vertices, not a surface of "
                         "triangles");
    }
    refuse_other_content(path, bytes);
    refuse_other_mesh(path, bytes, ".asc");
    fail_input(path, "is no FreeSurfer surface: it begins neither with its magic number nor with "
                     "'#!ascii'");
}

} // namespace geodisk::tools
