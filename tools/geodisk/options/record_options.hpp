// The options that say what samples are written with: attributes of the mesh, normals, frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "files/meshes/mesh_fields.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_format.hpp"
#include "geometry/frames.hpp"

namespace geodisk::tools {

class Command;

/// Source of the normals of samples.
enum class NormalKind : std::uint8_t { face, file, smooth };

/// As given on the command line.
struct RecordOptions {
    std::string attributes; ///< As parse_fields() reads them.
    std::string texture;    ///< Image, kAutoTexture, or "".
    std::string normals = "face";
    std::string frames; ///< As parse_frame_style() reads it, kBareFlag, or "" for none.

    /// Throws UserError(usage) for another word.
    NormalKind normal_kind() const;
    /// Returns how frames turn, but for the axis of the mesh that points up; nothing without
    /// frames. Throws UserError(usage).
    std::optional<FrameStyle> frame_style() const;
    /// Returns the image; "" for none, and for the materials of the mesh.
    std::string image() const { return texture == kAutoTexture ? "" : texture; }
    /// Returns what to read of the mesh. Throws UserError(usage) as parse_fields().
    WantedFields fields() const;
    /// Throws UserError(usage) if the format holds no such columns.
    void check(const SampleTarget& target) const;
    /// Returns what a header says of them, but for frames; nothing of those that were not given.
    HeaderEntries entries() const;
};

/// Adds --attributes, of the mesh `name`.
void add_attributes_option(Command command, RecordOptions& options,
                           const std::string& name = "MESH");

/// Adds --attributes, --texture, --normals and --frames, of the mesh `name`.
void add_record_options(Command command, RecordOptions& options, const std::string& name = "MESH");

} // namespace geodisk::tools
