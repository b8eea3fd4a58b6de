#include "geodisk/inputs/split_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

using Uv = std::array<double, 2>;

/// Returns the texture coordinates of the corners of a part; the same to the bit for a whole face.
std::array<Uv, 3> uvs_of(const MeshFile& mesh, const FacePart& part) {
    const std::array<Uv, 3> of_face{uv_of_corner(mesh, part.face, 0),
                                    uv_of_corner(mesh, part.face, 1),
                                    uv_of_corner(mesh, part.face, 2)};
    std::array<Uv, 3> uvs;
    for (std::size_t k = 0; k < 3; ++k) {
        const double second = part.corners[k][0], third = part.corners[k][1];
        for (std::size_t i = 0; i < 2; ++i) {
            uvs[k][i] = ((FacePart::kSteps - second - third) * of_face[0][i] +
                         second * of_face[1][i] + third * of_face[2][i]) /
                        FacePart::kSteps;
        }
    }
    return uvs;
}

/// Longest edge of parts that are not split further, in pixels: the diagonal of one, and a little.
constexpr double kShown = 1.5;

/// Corners in an image, in pixels.
std::array<Uv, 3> pixels_of(const GreyImage& image, const std::array<Uv, 3>& uvs) {
    std::array<Uv, 3> pixels;
    for (std::size_t k = 0; k < 3; ++k) {
        pixels[k] = {uvs[k][0] * static_cast<double>(image.width()),
                     uvs[k][1] * static_cast<double>(image.height())};
    }
    return pixels;
}

/// Returns the longest edge, by operations that round alike everywhere.
double longest_of(const std::array<Uv, 3>& pixels) {
    double longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Uv &a = pixels[k], &b = pixels[(k + 1) % 3];
        const double x = b[0] - a[0], y = b[1] - a[1];
        longest2 = std::max(longest2, x * x + y * y);
    }
    return std::sqrt(longest2);
}

/// Returns how many pixels apart a whole face is looked at, which is split into so many parts.
double stride_of(const GreyImage& image, const std::array<Uv, 3>& whole) {
    return std::max(1.0, longest_of(pixels_of(image, whole)) / FacePart::kSteps);
}

/// A part of a face in an image.
class ImagePart {
  public:
    /// `whole` are the texture coordinates of the face.
    ImagePart(const ReadImage& read, const std::array<Uv, 3>& uvs, const std::array<Uv, 3>& whole)
        : read_(read), uvs_(uvs), pixels_(pixels_of(*read.image, uvs)),
          longest_(longest_of(pixels_)), stride_(stride_of(*read.image, whole)) {}

    /// Returns the longest edge, in pixels.
    double longest() const { return longest_; }

    bool has_detail() const {
        if (!(longest_ > kShown)) {
            return false;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            greys_[k] = read_.image->at(uvs_[k][0], uvs_[k][1]);
        }
        constexpr double kThird = 1.0 / 3;
        return matters(0.5, 0) || matters(0, 0.5) || matters(0.5, 0.5) || matters(kThird, kThird) ||
               is_any_inside();
    }

  private:
    /// Looks at centres of pixels inside the part, or as many as there may be parts.
    bool is_any_inside() const {
        const Uv ab{pixels_[1][0] - pixels_[0][0], pixels_[1][1] - pixels_[0][1]};
        const Uv ac{pixels_[2][0] - pixels_[0][0], pixels_[2][1] - pixels_[0][1]};
        const double area = ab[0] * ac[1] - ab[1] * ac[0];
        if (area == 0) {
            return false;
        }
        const auto [left, right] = std::minmax({pixels_[0][0], pixels_[1][0], pixels_[2][0]});
        const auto [low, high] = std::minmax({pixels_[0][1], pixels_[1][1], pixels_[2][1]});
        const double rows = std::floor((high - low) / stride_) + 1,
                     columns = std::floor((right - left) / stride_) + 1;
        for (double row = 0; row <= rows; ++row) {
            const double dy = std::floor(low) + 0.5 + row * stride_ - pixels_[0][1];
            for (double column = 0; column <= columns; ++column) {
                const double dx = std::floor(left) + 0.5 + column * stride_ - pixels_[0][0];
                const double second = (dx * ac[1] - dy * ac[0]) / area;
                const double third = (ab[0] * dy - ab[1] * dx) / area;
                if (second >= 0 && third >= 0 && second + third <= 1 && matters(second, third)) {
                    return true;
                }
            }
        }
        return false;
    }

    bool matters(double second, double third) const {
        const double first = 1 - second - third;
        const double grey =
            read_.image->at(first * uvs_[0][0] + second * uvs_[1][0] + third * uvs_[2][0],
                            first * uvs_[0][1] + second * uvs_[1][1] + third * uvs_[2][1]);
        const double linear = first * greys_[0] + second * greys_[1] + third * greys_[2];
        return read_.matters(grey, linear, greys_);
    }

    const ReadImage& read_;
    std::array<Uv, 3> uvs_, pixels_;
    double longest_, stride_;
    mutable std::array<double, 3> greys_{};
};

/// Distance between readings of an image on faces that do not show all of it.
struct Coarse {
    std::uint64_t faces = 0;
    double pixels = 0;

    void add(const Coarse& other) {
        faces += other.faces;
        pixels = std::max(pixels, other.pixels);
    }
};

/// Splits the faces of a mesh, see split_for_images().
class ImageSplitter {
  public:
    ImageSplitter(const MeshFile& mesh, const std::vector<ReadImage>& images)
        : mesh_(mesh), images_(images), coarse_(images.size()), split_(mesh),
          is_done_(mesh.triangle_count(), false) {}

    BisectedMesh run() {
        note_large_faces();
        const std::size_t most = mesh_.triangle_count() + kMaxAdded;
        for (;;) {
            std::vector<Coarse> left(images_.size());
            const std::vector<bool> wanted = find_wanted(left);
            const auto before = split_.split(wanted, most);
            if (!before) {
                for (std::size_t i = 0; i < images_.size(); ++i) {
                    coarse_[i].add(left[i]);
                }
                return std::move(split_);
            }
            std::vector<bool> done;
            done.reserve(before->size());
            for (const std::uint32_t t : *before) {
                done.push_back(is_done_[t]);
            }
            is_done_ = std::move(done);
        }
    }

    void warn(std::vector<MeshWarning>& warnings) const {
        for (std::size_t i = 0; i < images_.size(); ++i) {
            if (coarse_[i].faces > 0) {
                warnings.push_back({"fine_image", coarse_[i].faces, "",
                                    "is finer than faces are split for it: on large faces it is "
                                    "read every " +
                                        rounded(std::ceil(coarse_[i].pixels), 6) +
                                        " pixels; split them in the mesh to show more",
                                    images_[i].name});
            }
        }
    }

  private:
    static constexpr std::size_t kMaxAdded = std::size_t{1} << 20;

    void note_large_faces() {
        for (std::size_t face = 0; face < mesh_.triangle_count(); ++face) {
            for (std::size_t i = 0; i < images_.size() && mesh_.takes_part(face); ++i) {
                const double stride =
                    stride_of(*images_[i].image, uvs_of(mesh_, split_.parts()[face]));
                if (stride > 1) {
                    coarse_[i].add({1, stride});
                }
            }
        }
    }

    /// Returns which triangles do not show what matters, and adds those to `left`.
    std::vector<bool> find_wanted(std::vector<Coarse>& left) {
        std::vector<bool> wanted(split_.triangle_count(), false);
        for (std::size_t t = 0; t < wanted.size(); ++t) {
            const FacePart& part = split_.parts()[t];
            if (is_done_[t] || !mesh_.takes_part(part.face)) {
                continue;
            }
            if (t % 1024 == 0) {
                check_interrupted();
            }
            const std::array<Uv, 3> uvs = uvs_of(mesh_, part);
            const std::array<Uv, 3> whole = uvs_of(mesh_, FacePart{part.face});
            for (std::size_t i = 0; i < images_.size(); ++i) {
                const ImagePart in_image(images_[i], uvs, whole);
                if (in_image.has_detail()) {
                    wanted[t] = true;
                    left[i].add({1, in_image.longest()});
                }
            }
            is_done_[t] = !wanted[t];
        }
        return wanted;
    }

    const MeshFile& mesh_;
    const std::vector<ReadImage>& images_;
    std::vector<Coarse> coarse_;
    BisectedMesh split_;
    std::vector<bool> is_done_; ///< Triangles that show what matters, or are parts of such.
};

} // namespace

SplitFaces::SplitFaces(const MeshFile& mesh, BisectedMesh parts) : parts_(std::move(parts)) {
    std::uint32_t next = static_cast<std::uint32_t>(mesh.triangle_count());
    keys_.reserve(parts_.triangle_count());
    for (std::size_t t = 0; t < parts_.triangle_count(); ++t) {
        const std::uint32_t face = parts_.parts()[t].face;
        const bool is_first = t == 0 || parts_.parts()[t - 1].face != face;
        keys_.push_back(is_first ? face : next++);
        if (!mesh.takes_part(face)) {
            continue;
        }
        const std::array<Uv, 3> uvs = uvs_of(mesh, parts_.parts()[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            uvs_.push_back({parts_.triangles()[3 * t + k], uvs[k][0], uvs[k][1]});
        }
    }
    sort_uvs(uvs_);
}

std::optional<SplitFaces> split_for_images(const MeshFile& mesh,
                                           const std::vector<ReadImage>& images,
                                           std::vector<MeshWarning>& warnings) {
    ImageSplitter splitter(mesh, images);
    BisectedMesh parts = splitter.run();
    splitter.warn(warnings);
    return parts.is_split() ? std::optional<SplitFaces>(std::in_place, mesh, std::move(parts))
                            : std::nullopt;
}

} // namespace geodisk::tools
