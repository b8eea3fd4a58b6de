"""The structs and numbers of geodisk/geodisk.h and of geodisk_python.h."""

from __future__ import annotations

from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_float,
    c_int32,
    c_int64,
    c_size_t,
    c_uint8,
    c_uint32,
    c_uint64,
    c_void_p,
    sizeof,
)
from typing import Any

FLOAT64, FLOAT32, UINT32, UINT16 = range(4)
FACE, BARYCENTRIC, POSITION, NORMAL, RADIUS, PART, CLASS, FEATURE, LEVEL = range(9)
METRICS = {"geodesic": 0, "euclidean": 1, "approximate": 2}
AMONG = {"vertices": 0, "sources": 2}
AMONG_POINTS = 1
NO_ELEMENT = 2**64 - 1


class _Sized(Structure):
    """A struct that begins with its size."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(struct_size=sizeof(type(self)), **fields)


class CError(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("status", c_int32),
        ("vk_result", c_int32),
        ("element", c_uint64),
        ("message", c_char * 1024),
    ]


class DeviceInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("is_usable", c_int32),
        ("type", c_uint32),
        ("vendor_id", c_uint32),
        ("device_id", c_uint32),
        ("api_version", c_uint32),
        ("driver_version", c_uint32),
        ("compute_queue_family", c_uint32),
        ("graphics_queue_family", c_uint32),
        ("memory_bytes", c_uint64),
        ("uuid", c_uint8 * 16),
        ("name", c_char * 256),
        ("driver", c_char * 512),
        ("reasons", c_char * 1024),
    ]


class DeviceOptions(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("device", c_char_p),
        ("validation", c_int32),
        ("keep_pipelines", c_int32),
    ]


class MeshParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("positions", c_void_p),
        ("position_type", c_int32),
        ("dimension", c_uint32),
        ("vertex_count", c_size_t),
        ("position_stride", c_size_t),
        ("indices", c_void_p),
        ("index_type", c_int32),
        ("face_count", c_size_t),
        ("index_stride", c_size_t),
        ("edge_lengths", c_void_p),
        ("weld", c_int32),
        ("weld_distance", c_double),
        ("max_threads", c_uint32),
        ("keep_seams", c_int32),
    ]


class MeshInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("dimension", c_uint32),
        ("vertices", c_uint64),
        ("faces", c_uint64),
        ("components", c_uint64),
        ("boundary_edges", c_uint64),
        ("coinciding_border_edges", c_uint64),
        ("nonmanifold_edges", c_uint64),
        ("repeated_index_faces", c_uint64),
        ("zero_area_faces", c_uint64),
        ("merged_vertices", c_uint64),
        ("area", c_double),
        ("diagonal", c_double),
        ("longest_edge", c_double),
        ("joined_edges", c_uint64),
    ]


class Rule(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("field", c_char_p),
        ("other", c_char_p),
        ("reason", c_char_p),
    ]


class SurfaceParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("min_distance", c_double),
        ("seed", c_uint64),
        ("pool_ratio", c_double),
        ("darts", c_uint32),
        ("stop_count", c_uint32),
        ("radii", c_void_p),
        ("face_keys", c_void_p),
        ("metric", c_int32),
        ("face_mask", c_void_p),
        ("existing", c_void_p),
        ("existing_count", c_size_t),
        ("avoid", c_void_p),
        ("avoid_radii", c_void_p),
        ("avoid_count", c_size_t),
        ("class_factors", c_void_p),
        ("class_count", c_size_t),
        ("existing_classes", c_void_p),
        ("is_maximal", c_int32),
        ("avoid_classes", c_void_p),
        ("class_shares", c_void_p),
    ]


class BoxParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("extents", POINTER(c_double)),
        ("dimension", c_uint32),
        ("is_periodic", c_int32),
        ("min_distance", c_double),
        ("seed", c_uint64),
        ("pool_ratio", c_double),
        ("darts", c_uint32),
        ("stop_count", c_uint32),
    ]


class BoxRequest(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("params", POINTER(BoxParams)),
        ("count", c_double),
        ("is_exact", c_int32),
    ]


class SamplerOptions(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("device_bytes", c_uint64),
        ("submission_seconds", c_double),
        ("stall_seconds", c_double),
    ]


class Progress(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("decided", c_uint32),
        ("candidates", c_uint32),
        ("accepted", c_uint32),
        ("disks", c_uint32),
        ("windows", c_uint64),
    ]


PROGRESS_FN = CFUNCTYPE(c_int32, c_void_p, POINTER(Progress))


#: Orders that geodisk_request.order takes.
ORDERS = {"dart": 0, "progressive": 1}


class Request(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("params", POINTER(SurfaceParams)),
        ("count", c_double),
        ("is_exact", c_int32),
        ("order", c_int32),
        ("features", c_double),
        ("level_factor", c_double),
        ("levels", c_uint32),
        ("keep", c_uint32),
        ("class_counts", c_void_p),
    ]


class MeshRequest(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("mesh", c_void_p),
        ("request", POINTER(Request)),
    ]


class Report(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("samples", c_uint64),
        ("candidates", c_uint32),
        ("batches", c_uint32),
        ("dispatches", c_uint32),
        ("disks", c_uint32),
        ("windows", c_uint64),
        ("device_bytes", c_uint64),
        ("min_distance", c_double),
        ("guard", c_double),
        ("rho", c_double),
        ("compile_seconds", c_double),
        ("upload_seconds", c_double),
        ("sample_seconds", c_double),
        ("readback_seconds", c_double),
        ("missing", c_uint32),
        ("existing", c_uint32),
        ("maximal_rounds", c_uint32),
        ("is_certified", c_int32),
        ("maximal_cells", c_uint64),
        ("largest_gap", c_double),
        ("tries", c_uint32),
        ("levels", c_uint32),
        ("level_factor", c_double),
        ("cut", c_uint64),
        ("corners", c_uint64),
        ("feature_length", c_double),
        ("lacks_features", c_int32),
        ("cover", c_double),
    ]


class UpdateInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("rounds", c_uint32),
        ("faces", c_uint32),
        ("uploaded", c_uint32),
        ("removed", c_uint32),
        ("added", c_uint32),
        ("disks", c_uint32),
    ]


class NeighbourParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sources", c_void_p),
        ("source_vertices", c_void_p),
        ("source_count", c_size_t),
        ("within", c_double),
        ("radii", c_void_p),
        ("kind", c_int32),
        ("points", c_void_p),
        ("point_count", c_size_t),
        ("nearest", c_uint32),
        ("max_pairs", c_uint64),
        ("joined", c_void_p),
    ]


class NeighbourArrays(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("source_count", c_size_t),
        ("pair_count", c_size_t),
        ("vertices", POINTER(c_uint32)),
        ("offsets", POINTER(c_uint64)),
        ("indices", POINTER(c_uint32)),
        ("distances", POINTER(c_float)),
        ("error", c_double),
    ]


class DistanceParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sources", c_void_p),
        ("source_vertices", c_void_p),
        ("source_count", c_size_t),
        ("targets", c_void_p),
        ("target_count", c_size_t),
        ("each", c_int32),
        ("max_threads", c_uint32),
        ("within", c_double),
        ("joined", c_void_p),
    ]


class PathParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("from", c_void_p),
        ("to", c_void_p),
        ("from_vertex", c_uint32),
        ("to_vertex", c_uint32),
    ]


class PathPoint(Structure):
    _fields_ = [("face", c_uint32), ("weights", c_double * 3)]


class CellParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("samples", c_void_p),
        ("sample_count", c_size_t),
        ("areas_only", c_int32),
        ("max_records", c_uint64),
        ("face_mask", c_void_p),
    ]


class CellArrays(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sample_count", c_size_t),
        ("edge_count", c_size_t),
        ("triangle_count", c_size_t),
        ("areas", POINTER(c_double)),
        ("edges", POINTER(c_uint32)),
        ("triangles", POINTER(c_uint32)),
        ("area_error", c_double),
        ("distance_error", c_double),
        ("unreached", c_double),
        ("manifold_triangles", c_uint64),
        ("euler", c_int64),
        ("mesh_euler", c_int64),
    ]


class FarthestParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("samples", c_void_p),
        ("sample_count", c_size_t),
        ("count", c_uint32),
        ("start", c_uint32),
        ("existing", c_uint32),
    ]


class FarthestInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("cover", c_double),
        ("error", c_double),
        ("searches", c_uint32),
    ]


class SourceParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("path", c_char_p),
        ("positions", c_void_p),
        ("dimension", c_uint32),
        ("vertex_count", c_size_t),
        ("corners", c_void_p),
        ("face_ends", c_void_p),
        ("face_count", c_size_t),
        ("weld", c_int32),
        ("weld_distance", c_double),
        ("attributes", POINTER(c_char_p)),
        ("attribute_count", c_size_t),
        ("stop", POINTER(c_int32)),
        ("keep_seams", c_int32),
        ("mesh_format", c_char_p),
        ("columns", c_char_p),
        ("has_normals", c_int32),
        ("has_uvs", c_int32),
        ("has_materials", c_int32),
        ("allow_outside", c_int32),
    ]


#: Kinds of normals by name.
NORMALS = {"face": 0, "file": 1, "smooth": 2}


class RecordParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("faces", c_void_p),
        ("weights", c_void_p),
        ("count", c_size_t),
        ("normal_kind", c_int32),
        ("texture", c_char_p),
        ("seed", c_uint64),
        ("normals", c_void_p),
        ("colours", c_void_p),
        ("frames", c_void_p),
        ("frame_style", c_char_p),
        ("up", c_char_p),
    ]


class SourceArrays(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("positions", POINTER(c_double)),
        ("dimension", c_uint32),
        ("vertex_count", c_size_t),
        ("triangles", POINTER(c_uint32)),
        ("triangle_count", c_size_t),
        ("polygons", POINTER(c_uint32)),
        ("polygon_count", c_size_t),
        ("joined", POINTER(c_uint32)),
        ("joined_edges", c_uint64),
        ("corners", POINTER(c_uint32)),
        ("attribute_count", c_size_t),
        ("is_y_up", c_int32),
    ]


class SourceAttribute(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("values", POINTER(c_double)),
        ("value_count", c_size_t),
        ("components", c_size_t),
        ("corners", POINTER(c_uint32)),
        ("of_vertices", c_int32),
        ("is_whole", c_int32),
        ("is_light", c_int32),
    ]


class Task(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("options", c_char_p),
        ("samples", c_void_p),
        ("faces", c_void_p),
        ("mesh", c_void_p),
        ("to", c_void_p),
        ("radii", c_void_p),
        ("face_mask", c_void_p),
        ("avoid", c_void_p),
        ("avoid_radii", c_void_p),
        ("source", c_void_p),
        ("nearest", c_void_p),
        ("stop", POINTER(c_int32)),
        ("map_samples", c_void_p),
        ("map_distances", c_void_p),
        ("map_faces", c_void_p),
    ]


TAKE_FN = CFUNCTYPE(None, c_void_p, c_size_t)
