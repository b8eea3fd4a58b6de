#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "geometry/frames.hpp"
#include "geometry/vec.hpp"
#include "program/exact_text.hpp"
#include "program/path.hpp"

namespace geodisk::tools {
namespace {

/// Angles of RELION in degrees, see particle_angles().
struct ParticleAngles {
    double rot = 0, tilt = 0, psi = 0;
};

/// Returns the angles by which RELION turns its reference to the particle that the quaternion
/// x y z w places. RELION turns coordinates by `rot` about z, by `tilt` about the new y and by
/// `psi` about the new z. So its rotation of the reference is Rz(-psi) Ry(-tilt) Rz(-rot).
ParticleAngles particle_angles(const double (&q)[4]) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    constexpr double kUpright =
        1e-9; // A sine of the tilt that leaves nothing but one turn about z.
    const auto [x, y, z, w] = q;
    const double up_x = 2 * (x * z + y * w), up_y = 2 * (y * z - x * w); // Where z points to.
    const double across = std::hypot(up_x, up_y);
    ParticleAngles angles;
    angles.tilt = kDegrees * std::atan2(across, 1 - 2 * (x * x + y * y));
    if (across > kUpright) {
        angles.psi = kDegrees * std::atan2(up_y, -up_x);
        angles.rot = kDegrees * std::atan2(2 * (y * z + x * w), 2 * (x * z - y * w));
    } else {
        angles.rot = kDegrees * std::atan2(-2 * (x * y + z * w), 1 - 2 * (x * x + z * z));
    }
    return angles;
}

/// Returns the angles that turn z to a normal, without a turn about it.
ParticleAngles particle_angles(const float (&normal)[3]) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    const double x = normal[0], y = normal[1], z = normal[2], across = std::hypot(x, y);
    ParticleAngles angles;
    angles.tilt = kDegrees * std::atan2(across, z);
    angles.psi = across > 0 ? kDegrees * std::atan2(y, -x) : 0;
    return angles;
}

/// Returns a word for the mesh of the header: its file without folder and extension.
std::string micrograph_name(const SampleHeader& header) {
    const std::string* const mesh = header.find("mesh");
    const std::u8string stem = Path(mesh == nullptr ? std::string() : *mesh).stem().u8string();
    std::string name(stem.begin(), stem.end());
    for (char& c : name) {
        const auto byte = static_cast<unsigned char>(c);
        c = byte <= ' ' || byte == 127 || c == '"' || c == '\'' || c == '#' || c == ':' ? '_' : c;
    }
    return name.empty() || name.front() == '_' || name.front() == '$' ? "mesh" + name : name;
}

/// The columns that hold attributes and what else is known of samples.
SampleLayout further_layout(const SampleLayout& layout, std::vector<SampleField>& fields) {
    SampleLayout further = layout;
    further.named = 0;
    further.dimension = 0;
    further.is_on_surface = false;
    for (const SampleField& field : layout.further.fields) {
        if (field.name != kFramesField) {
            fields.push_back(field);
        }
    }
    further.further.fields = fields;
    return further;
}

} // namespace

void write_star(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout) {
    const SampleField* const frames = find_frames(layout.further);
    const bool has_angles = frames != nullptr || layout.has_normals();
    std::vector<SampleField> fields;
    const SampleLayout further = further_layout(layout, fields);
    const std::string name = micrograph_name(header);

    std::string text = entry_lines(header, target, "# ");
    std::size_t count = 0;
    const auto add_label = [&](std::string_view label) {
        text += '_' + std::string(label) + " #" + std::to_string(++count) + '\n';
    };
    text += "\ndata_optics\n\nloop_\n";
    add_label("rlnOpticsGroupName");
    add_label("rlnOpticsGroup");
    if (target.pixel_size) {
        add_label("rlnImagePixelSize");
    }
    text += "opticsGroup1 1" +
            (target.pixel_size ? ' ' + exact_text(*target.pixel_size) : std::string()) +
            "\n\n\ndata_particles\n\nloop_\n";
    count = 0;
    for (const char* const label : {"rlnCoordinateX", "rlnCoordinateY", "rlnCoordinateZ",
                                    "rlnMicrographName", "rlnTomoName", "rlnOpticsGroup"}) {
        add_label(label);
    }
    if (has_angles) {
        for (const char* const label : {"rlnAngleRot", "rlnAngleTilt", "rlnAnglePsi"}) {
            add_label(label);
        }
    }
    visit_columns({}, 0, further, [&](std::string_view column, auto) { add_label(column); });
    file.write(text);

    const double pixel = target.pixel_size.value_or(1);
    const std::string middle = ' ' + name + ' ' + name + " 1";
    write_each(file, rows.size(), [&](std::string& bytes, std::size_t i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bytes += axis > 0 ? " " : "";
            append_number(bytes, rows[i].position[axis] / pixel);
        }
        bytes += middle;
        if (has_angles) {
            ParticleAngles angles = particle_angles(rows[i].normal);
            if (frames != nullptr) {
                const double* const q = &frames->values[4 * i];
                angles = particle_angles({q[0], q[1], q[2], q[3]});
            }
            for (const double angle : {angles.rot, angles.tilt, angles.psi}) {
                bytes += ' ';
                append_number(bytes, angle);
            }
        }
        visit_columns(rows[i], i, further, [&](std::string_view, auto value) {
            bytes += ' ';
            append_number(bytes, value);
        });
        bytes += '\n';
    });
    file.write("\n");
}

} // namespace geodisk::tools
