// The samples nearest to a place, by exact geodesic distance: the least over the windows that the place
// is seen through. Whoever includes this has the records and says where they are: kSeam, face_at(),
// cell_start(), window_at(), radius_of(), kind_of() and is_shown(). Also for GLSL ES 3.00, where a `const` is one
// at compile time.

// Reach of a density estimate, in radii of the sample.
const float kKernel = 5.0;
const float kPi = 3.14159265;

// Distances from the two nearest samples, in their radii; the kinds of the disks that cover the place,
// a bit each, and if two of one kind do.
struct Nearest {
    float first; float second;
    uint sample_index;
    uint kinds; bool overlaps;
};
const Nearest kNoNearest = Nearest(1e30, 1e30, ~0u, 0u, false);

// Takes a sample whose distance is known.
void take_sample(uint index, float distance, inout Nearest nearest, inout float density) {
    if (!is_shown(index)) {
        return;
    }
    float radius = radius_of(index);
    float relative = distance / radius;
    if (relative < nearest.first) {
        nearest.second = nearest.first;
        nearest.first = relative;
        nearest.sample_index = index;
    } else {
        nearest.second = min(nearest.second, relative);
    }
    if (relative < 1.0) {
        uint kind = 1u << kind_of(index);
        nearest.overlaps = nearest.overlaps || (nearest.kinds & kind) != 0u;
        nearest.kinds |= kind;
    }
    float part = relative / kKernel;
    if (part < 1.0) {
        density += 2.0 * (1.0 - part * part) / (kPi * kKernel * kKernel * radius * radius);
    }
}

// At `in_face`, in the frame of the face. Windows of a cell are in the order of their samples.
Nearest look_up(uint face_index, vec2 in_face, out float density) {
    const float kFar = 1e30;
    FaceRec face = face_at(face_index);
    vec2 cells = clamp(in_face * face.cells_per_unit, vec2(0), vec2(face.columns, face.rows) - 0.5);
    uint cell = face.first_cell + uint(cells.y) * face.columns + uint(cells.x);
    Nearest nearest = kNoNearest;
    density = 0.0;
    uint index = ~0u;
    float distance = kFar;
    uint end = cell_start(cell + 1u);
    for (uint i = cell_start(cell); i < end; ++i) {
        WindowRec window = window_at(i);
        if (window.sample_index != index) {
            if (distance < kFar) {
                take_sample(index, distance, nearest, density);
            }
            index = window.sample_index;
            distance = kFar;
        }
        vec2 way = in_face - vec2(window.x, window.y);
        if (dot(vec2(window.left_x, window.left_y), way) >= -kSeam &&
            dot(vec2(window.right_x, window.right_y), way) >= -kSeam) {
            distance = min(distance, window.sigma + length(way));
        }
    }
    if (distance < kFar) {
        take_sample(index, distance, nearest, density);
    }
    return nearest;
}
