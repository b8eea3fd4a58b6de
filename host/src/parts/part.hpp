// Part: what one process knows of a surface that many sample together.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/drawn.hpp"
#include "mesh/radius_pieces.hpp"
#include "mesh/ranks.hpp"
#include "parts/checkpoint.hpp"

namespace geodisk {

struct WholeSurface;

/// Role of a face for a process.
enum class FaceRole : std::uint8_t {
    surface, ///< Paths cross it.
    near,    ///< Its samples, which another process decides, may reject those of own faces.
    own,     ///< The process decides its candidates.
};

/// A process that decides faces near those of this one, or the other way round.
struct Neighbour {
    std::uint32_t process = 0;
    /// Own faces, by their numbers in the part, whose samples it must know. Ascending.
    std::vector<std::uint32_t> faces;
};

/// Faces by the places of their vertices, from which a mesh is made.
struct FacePlaces {
    std::vector<double> positions;        ///< Three coordinates per vertex.
    std::vector<std::uint32_t> triangles; ///< Three vertices per face.
    VertexRadii radii;                    ///< Radii at vertices; empty where radii do not vary.
    RadiusField of_whole;                 ///< Radii of the whole, without faces; likewise.
};

/// Own faces of a process, and the surface around them: faces whose samples matter to them, and
/// all that paths from those cross within the same distance. So disks are as on the whole. Faces
/// and vertices are in the order of the whole.
struct Part {
    JobFrame frame;    ///< Frame of the whole.
    double reach = 0;  ///< No samples farther away than this conflict with those of own faces.
    PreparedMesh mesh; ///< See MeshTurn.
    /// Source of mesh and radii, if it is a surface of this process; it outlives the part.
    const PreparedMesh* of_mesh = nullptr;
    const RadiusField* of_radii = nullptr;
    FacePlaces places;                ///< Source otherwise; empty once held for good.
    MeshStatistics whole;             ///< Statistics of the whole, likewise.
    std::optional<RadiusField> radii; ///< With the mesh.
    std::vector<std::uint32_t> faces; ///< Number in the whole of each face.
    Ranks ranks;                      ///< Of these numbers, with a mesh made of `of_mesh`.
    std::vector<FaceRole> roles;
    std::vector<std::uint32_t> keys; ///< Key of each face, or empty: its number in the whole.
    bool has_keys = false;           ///< The caller has given keys.
    std::vector<std::uint8_t> mask;  ///< Empty, or as SampleParams::face_mask.
    std::vector<Sample> existing;
    std::vector<KeepOut> avoid;
    /// As in SampleParams; empty if samples have no classes.
    std::vector<float> class_factors;
    std::vector<std::uint8_t> existing_classes, avoid_classes;
    std::vector<Neighbour> neighbours;
    SampleParams of_whole{};        ///< Numbers of the job, see numbers_of().
    std::uint32_t all_existing = 0; ///< Number of existing samples of the whole.
    std::uint32_t max_stages = 1;   ///< Stages that are drawn at a time.
    CheckpointTerms checkpoints;
    bool is_listed = false; ///< Candidates are those of a list:
    Darts listed;           ///< Those on own and near faces, as of a single stage.
    Darts settled; ///< Samples of the checkpoint that it goes on from, on own and near faces.

    /// Returns the place of a face of the whole, if it belongs to the part.
    std::uint32_t local(std::uint32_t face) const;
    /// Returns true if that is its place.
    bool has(std::uint32_t place, std::uint32_t face) const {
        return place < faces.size() && faces[place] == face;
    }
    /// Returns true if a face of the whole belongs to the part.
    bool has(std::uint32_t face) const { return has(local(face), face); }
    /// Returns some faces of the part, given by their places, with their mesh, which this must
    /// have. It has parameters, but no candidates and samples.
    std::unique_ptr<Part> cut_out(std::span<const std::uint32_t> some_faces) const;
    /// Returns the parameters of the whole, for the part. They refer to it.
    SampleParams params() const;
    /// Returns the candidates of the whole, on the faces of the part, if they are drawn.
    CandidateDraw draw() const;
    /// Returns the stages of the whole.
    Stages stages() const;
};

/// Returns a part without any faces yet, for a job in such a frame. At most so many
/// candidates are expected to be drawn at a time, of all processes, unless one stage has more.
Part part_for(const SampleParams& params, const JobFrame& frame, double max_candidates,
              const CheckpointTerms& checkpoints);

/// Returns the parts of all processes as messages, in their order. The frame is that of the whole,
/// and `owners` has the process of each face. Errors: `invalid_argument` for parameters that many
/// processes do not take; those of PreparedMesh::save().
Result<std::vector<Bytes>> divide(const WholeSurface& whole, const JobFrame& frame,
                                  std::span<const std::uint32_t> owners, std::uint32_t processes);

/// Returns a part as a message. Errors: those of PreparedMesh::save().
Result<Bytes> message_of(const Part& part);

/// Reads a part. Errors: those of PreparedMesh::load() and the like.
Result<std::unique_ptr<Part>> part_of(std::span<const std::byte> bytes);

} // namespace geodisk
