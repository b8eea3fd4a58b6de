#include "geodisk/options/record_options.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "files/samples/frame_style.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// By NormalKind.
const std::vector<std::string>& normal_names() {
    static const std::vector<std::string> kNames{"face", "file", "smooth"};
    return kNames;
}

} // namespace

NormalKind RecordOptions::normal_kind() const {
    const auto found = std::ranges::find(normal_names(), normals);
    if (found == normal_names().end()) {
        fail_choice("--normals", normals, normal_names());
    }
    return NormalKind(found - normal_names().begin());
}

std::optional<FrameStyle> RecordOptions::frame_style() const {
    if (frames.empty()) {
        return std::nullopt;
    }
    return parse_frame_style("--frames", frames == kBareFlag ? "" : frames);
}

WantedFields RecordOptions::fields() const {
    WantedFields fields = parse_fields(attributes);
    fields.normals = normal_kind() == NormalKind::file;
    fields.uvs = !image().empty();
    fields.materials = texture == kAutoTexture;
    fields.has_texture = !texture.empty();
    return fields;
}

void RecordOptions::check(const SampleTarget& target) const {
    for (const auto& [is_given, columns] : {std::pair{!attributes.empty(), "of --attributes"},
                                            {!texture.empty(), "of --texture"},
                                            {frame_style().has_value(), "of --frames"}}) {
        if (is_given) {
            check_columns(target, std::vector<std::string>{columns});
        }
    }
    if (normal_kind() != NormalKind::face &&
        facts_of(target.format).content == SampleContent::points) {
        check_columns(target, std::vector<std::string>{"of --normals"});
    }
}

HeaderEntries RecordOptions::entries() const {
    HeaderEntries entries;
    if (!attributes.empty()) {
        entries.emplace_back("attributes", attributes);
    }
    if (!texture.empty()) {
        entries.emplace_back("texture", texture);
    }
    if (normal_kind() != NormalKind::face) {
        entries.emplace_back("normals", normals);
    }
    return entries;
}

void add_attributes_option(Command command, RecordOptions& options, const std::string& name) {
    command.add_option("--attributes", options.attributes, "LIST",
                       "Add attributes that " + name +
                           " has at each sample: all, or names\n"
                           "separated by commas: color, uv, and others as the file calls\n"
                           "them, or file:FILE for values of its vertices. Integers are\n"
                           "those of the corner with the most weight");
}

void add_record_options(Command command, RecordOptions& options, const std::string& name) {
    add_attributes_option(command, options, name);
    command.add_option("--texture", options.texture, "IMAGE",
                       "Add the colour of an image (PNG, JPEG, WebP, TGA, BMP) at texture\n"
                       "coordinates of each sample; auto: that of the materials of a glTF\n"
                       "or OBJ file and their images");
    command
        .add_option("--normals", options.normals, "NAME",
                    "face: normals of triangles; file: those of the file, as\n"
                    "interpolated; smooth: interpolated means at vertices")
        .offers(normal_names())
        .shows_default();
    command.add_flag("--frames", options.frames,
                     "Add a quaternion qx qy qz qw to each sample, which rotates z\n"
                     "to its normal, with a random turn about it; glTF and USD then\n"
                     "place a triangle at each sample. --frames=y: for models whose\n"
                     "y points up. --frames=upright: keep them upright, as plants on\n"
                     "a hillside; --frames=0.3: turn them 0.3 of the way from there\n"
                     "to the normal; --frames=y,0.3: both. --up says where up is");
}

} // namespace geodisk::tools
