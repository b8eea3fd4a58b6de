// Offsets in the compiled SPIR-V against offsetof in C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/kernels/kernel_table.hpp"
#include "push.h"
#include "records.h"
#include "spirv.hpp"

namespace geodisk::test {
namespace {

#define GEODISK_OFFSET(type, member)                                                               \
    { #member, static_cast < std::uint32_t>(offsetof(gpu::type, member)) }

const Offsets kJob{GEODISK_OFFSET(JobRec, capacity),       GEODISK_OFFSET(JobRec, faces),
                   GEODISK_OFFSET(JobRec, vertices),       GEODISK_OFFSET(JobRec, cells),
                   GEODISK_OFFSET(JobRec, seed_low),       GEODISK_OFFSET(JobRec, seed_high),
                   GEODISK_OFFSET(JobRec, limit),          GEODISK_OFFSET(JobRec, margin),
                   GEODISK_OFFSET(JobRec, slack),          GEODISK_OFFSET(JobRec, path_rules),
                   GEODISK_OFFSET(JobRec, has_keys),       GEODISK_OFFSET(JobRec, first_key_row),
                   GEODISK_OFFSET(JobRec, stop_count),     GEODISK_OFFSET(JobRec, idle_capacity),
                   GEODISK_OFFSET(JobRec, buckets),        GEODISK_OFFSET(JobRec, base_error),
                   GEODISK_OFFSET(JobRec, first_mask_row), GEODISK_OFFSET(JobRec, first_class_row),
                   GEODISK_OFFSET(JobRec, max_lag)};

const Offsets kPush{GEODISK_OFFSET(Push, slots),           GEODISK_OFFSET(Push, batch),
                    GEODISK_OFFSET(Push, lanes),           GEODISK_OFFSET(Push, lanes_per_group),
                    GEODISK_OFFSET(Push, window_capacity), GEODISK_OFFSET(Push, table_capacity),
                    GEODISK_OFFSET(Push, list_capacity),   GEODISK_OFFSET(Push, lane_rows),
                    GEODISK_OFFSET(Push, first_list_row),  GEODISK_OFFSET(Push, first_slice_row),
                    GEODISK_OFFSET(Push, large_groups),    GEODISK_OFFSET(Push, large_after),
                    GEODISK_OFFSET(Push, step_budget),     GEODISK_OFFSET(Push, sample_capacity),
                    GEODISK_OFFSET(Push, list_groups),     GEODISK_OFFSET(Push, first_stage),
                    GEODISK_OFFSET(Push, stages),          GEODISK_OFFSET(Push, intensity),
                    GEODISK_OFFSET(Push, end_order),       GEODISK_OFFSET(Push, bucket_shift),
                    GEODISK_OFFSET(Push, scan_count),      GEODISK_OFFSET(Push, first_group)};

const Offsets kPlacePush{
    GEODISK_OFFSET(PlacePush, most),          GEODISK_OFFSET(PlacePush, last_vertex),
    GEODISK_OFFSET(PlacePush, stride),        GEODISK_OFFSET(PlacePush, position),
    GEODISK_OFFSET(PlacePush, normal),        GEODISK_OFFSET(PlacePush, has_normals),
    GEODISK_OFFSET(PlacePush, short_indices), GEODISK_OFFSET(PlacePush, vertices_each),
    GEODISK_OFFSET(PlacePush, radius),        GEODISK_OFFSET(PlacePush, first_group),
    GEODISK_OFFSET(PlacePush, avoided)};

const Offsets kNeighbourPush{
    GEODISK_OFFSET(NeighbourPush, count),         GEODISK_OFFSET(NeighbourPush, capacity),
    GEODISK_OFFSET(NeighbourPush, first_source),  GEODISK_OFFSET(NeighbourPush, sources),
    GEODISK_OFFSET(NeighbourPush, all_sources),   GEODISK_OFFSET(NeighbourPush, longest_word),
    GEODISK_OFFSET(NeighbourPush, width),         GEODISK_OFFSET(NeighbourPush, by_distance),
    GEODISK_OFFSET(NeighbourPush, nearest),       GEODISK_OFFSET(NeighbourPush, skips_own),
    GEODISK_OFFSET(NeighbourPush, has_names),     GEODISK_OFFSET(NeighbourPush, pairs),
    GEODISK_OFFSET(NeighbourPush, unit_low),      GEODISK_OFFSET(NeighbourPush, unit_high),
    GEODISK_OFFSET(NeighbourPush, unit_exponent), GEODISK_OFFSET(NeighbourPush, first_group)};

/// Returns the name of a kernel's push block, and how it lies.
std::pair<const char*, const Offsets&> push_of(const KernelInfo& info) {
    switch (info.domain) {
    case DomainKind::placement:
        return {"PlacePush", kPlacePush};
    case DomainKind::lists:
        return {"NeighbourPush", kNeighbourPush};
    default:
        return {"Push", kPush};
    }
}

const Offsets kControl{GEODISK_OFFSET(ControlRec, select_x),
                       GEODISK_OFFSET(ControlRec, select_y),
                       GEODISK_OFFSET(ControlRec, select_z),
                       GEODISK_OFFSET(ControlRec, detect_x),
                       GEODISK_OFFSET(ControlRec, detect_y),
                       GEODISK_OFFSET(ControlRec, detect_z),
                       GEODISK_OFFSET(ControlRec, groups_x),
                       GEODISK_OFFSET(ControlRec, groups_y),
                       GEODISK_OFFSET(ControlRec, groups_z),
                       GEODISK_OFFSET(ControlRec, abi),
                       GEODISK_OFFSET(ControlRec, generation),
                       GEODISK_OFFSET(ControlRec, drawn),
                       GEODISK_OFFSET(ControlRec, mode),
                       GEODISK_OFFSET(ControlRec, first_order),
                       GEODISK_OFFSET(ControlRec, batch_end),
                       GEODISK_OFFSET(ControlRec, list_end),
                       GEODISK_OFFSET(ControlRec, list_first),
                       GEODISK_OFFSET(ControlRec, list_width),
                       GEODISK_OFFSET(ControlRec, list_left),
                       GEODISK_OFFSET(ControlRec, listed_blocks),
                       GEODISK_OFFSET(ControlRec, first_range),
                       GEODISK_OFFSET(ControlRec, longest_span),
                       GEODISK_OFFSET(ControlRec, first_left),
                       GEODISK_OFFSET(ControlRec, due),
                       GEODISK_OFFSET(ControlRec, selected_groups),
                       GEODISK_OFFSET(ControlRec, idle),
                       GEODISK_OFFSET(ControlRec, next_sample),
                       GEODISK_OFFSET(ControlRec, slots_used),
                       GEODISK_OFFSET(ControlRec, next_slot),
                       GEODISK_OFFSET(ControlRec, large),
                       GEODISK_OFFSET(ControlRec, next_large),
                       GEODISK_OFFSET(ControlRec, large_x),
                       GEODISK_OFFSET(ControlRec, large_y),
                       GEODISK_OFFSET(ControlRec, large_z),
                       GEODISK_OFFSET(ControlRec, incomplete),
                       GEODISK_OFFSET(ControlRec, undecided),
                       GEODISK_OFFSET(ControlRec, overflow),
                       GEODISK_OFFSET(ControlRec, endless_face),
                       GEODISK_OFFSET(ControlRec, done),
                       GEODISK_OFFSET(ControlRec, below),
                       GEODISK_OFFSET(ControlRec, counted_order),
                       GEODISK_OFFSET(ControlRec, first_open),
                       GEODISK_OFFSET(ControlRec, ready),
                       GEODISK_OFFSET(ControlRec, accepted),
                       GEODISK_OFFSET(ControlRec, settled),
                       GEODISK_OFFSET(ControlRec, ordered),
                       GEODISK_OFFSET(ControlRec, next_ordered),
                       GEODISK_OFFSET(ControlRec, batches),
                       GEODISK_OFFSET(ControlRec, steps),
                       GEODISK_OFFSET(ControlRec, disks),
                       GEODISK_OFFSET(ControlRec, large_disks),
                       GEODISK_OFFSET(ControlRec, windows_low),
                       GEODISK_OFFSET(ControlRec, windows_high),
                       GEODISK_OFFSET(ControlRec, tested_low),
                       GEODISK_OFFSET(ControlRec, tested_high),
                       GEODISK_OFFSET(ControlRec, max_waiting),
                       GEODISK_OFFSET(ControlRec, max_windows),
                       GEODISK_OFFSET(ControlRec, longest_chain),
                       GEODISK_OFFSET(ControlRec, max_vertices),
                       GEODISK_OFFSET(ControlRec, max_conflicts),
                       GEODISK_OFFSET(ControlRec, trips_low),
                       GEODISK_OFFSET(ControlRec, trips_high),
                       GEODISK_OFFSET(ControlRec, lane_trips_low),
                       GEODISK_OFFSET(ControlRec, lane_trips_high)};

} // namespace

TEST_SUITE("layout") {
    TEST_CASE("push block, constants and control record lie alike in every kernel") {
        std::size_t controls = 0;
        for (std::size_t k = 0; k < kKernels; ++k) {
            const KernelInfo& info = kernel_info(static_cast<Kernel>(k));
            CAPTURE(info.name);
            for (const auto& spirv : {info.words(false), info.words(true)}) {
                const auto offsets = struct_offsets(spirv);
                const auto [push, expected] = push_of(info);
                REQUIRE(offsets.count(push) == 1);
                CHECK(offsets.at(push) == expected);
                if (offsets.count("JobRec") != 0) {
                    CHECK(offsets.at("JobRec") == kJob);
                }
                if (offsets.count("ControlRec") != 0) {
                    ++controls;
                    CHECK(offsets.at("ControlRec") == kControl);
                    // The blocker words follow the record without a gap.
                    CHECK(offsets.at("control_buffer").at("slots") == sizeof(gpu::ControlRec));
                }
            }
        }
        CHECK(controls == 36);
    }

    TEST_CASE("no kernel binds more than seven storage buffers") {
        for (std::size_t k = 0; k < kKernels; ++k) {
            CAPTURE(kernel_info(static_cast<Kernel>(k)).name);
            for (const bool texels : {false, true}) {
                const auto storage_buffers =
                    std::ranges::count(interface_of(static_cast<Kernel>(k), texels).bindings,
                                       VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, &KernelBinding::type);
                CHECK(storage_buffers >= 1);
                CHECK(storage_buffers <= 7);
            }
        }
    }
}

} // namespace geodisk::test
