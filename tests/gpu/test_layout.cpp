// Offsets in the compiled SPIR-V against offsetof in C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

#include "engine/kernels/kernel_table.hpp"
#include "push.h"
#include "records.h"
#include "spirv.hpp"

namespace geodisk::test {
namespace {

#define GEODISK_OFFSET(type, member)                                                               \
    { #member, static_cast < std::uint32_t>(offsetof(gpu::type, member)) }

const Offsets kPush{GEODISK_OFFSET(Push, capacity),        GEODISK_OFFSET(Push, faces),
                    GEODISK_OFFSET(Push, vertices),        GEODISK_OFFSET(Push, cells),
                    GEODISK_OFFSET(Push, seed_low),        GEODISK_OFFSET(Push, seed_high),
                    GEODISK_OFFSET(Push, limit),           GEODISK_OFFSET(Push, margin),
                    GEODISK_OFFSET(Push, slack),           GEODISK_OFFSET(Push, path_rules),
                    GEODISK_OFFSET(Push, slots),           GEODISK_OFFSET(Push, lanes),
                    GEODISK_OFFSET(Push, window_capacity), GEODISK_OFFSET(Push, table_capacity),
                    GEODISK_OFFSET(Push, list_capacity),   GEODISK_OFFSET(Push, lane_rows),
                    GEODISK_OFFSET(Push, first_list_row),  GEODISK_OFFSET(Push, step_budget),
                    GEODISK_OFFSET(Push, scan_count),      GEODISK_OFFSET(Push, sample_capacity),
                    GEODISK_OFFSET(Push, first_stage),     GEODISK_OFFSET(Push, stages),
                    GEODISK_OFFSET(Push, intensity),       GEODISK_OFFSET(Push, has_keys),
                    GEODISK_OFFSET(Push, all_single),      GEODISK_OFFSET(Push, end_order),
                    GEODISK_OFFSET(Push, stop_count),      GEODISK_OFFSET(Push, idle_capacity),
                    GEODISK_OFFSET(Push, buckets),         GEODISK_OFFSET(Push, bucket_shift),
                    GEODISK_OFFSET(Push, first_group),     GEODISK_OFFSET(Push, list_groups)};

const Offsets kPlacePush{
    GEODISK_OFFSET(PlacePush, most),          GEODISK_OFFSET(PlacePush, faces),
    GEODISK_OFFSET(PlacePush, vertices),      GEODISK_OFFSET(PlacePush, last_vertex),
    GEODISK_OFFSET(PlacePush, stride),        GEODISK_OFFSET(PlacePush, position),
    GEODISK_OFFSET(PlacePush, normal),        GEODISK_OFFSET(PlacePush, has_normals),
    GEODISK_OFFSET(PlacePush, short_indices), GEODISK_OFFSET(PlacePush, vertices_each),
    GEODISK_OFFSET(PlacePush, radius),        GEODISK_OFFSET(PlacePush, first_group)};

const Offsets kControl{GEODISK_OFFSET(ControlRec, select_x),
                       GEODISK_OFFSET(ControlRec, select_y),
                       GEODISK_OFFSET(ControlRec, select_z),
                       GEODISK_OFFSET(ControlRec, detect_x),
                       GEODISK_OFFSET(ControlRec, detect_y),
                       GEODISK_OFFSET(ControlRec, detect_z),
                       GEODISK_OFFSET(ControlRec, groups_x),
                       GEODISK_OFFSET(ControlRec, groups_y),
                       GEODISK_OFFSET(ControlRec, groups_z),
                       GEODISK_OFFSET(ControlRec, count_x),
                       GEODISK_OFFSET(ControlRec, count_y),
                       GEODISK_OFFSET(ControlRec, count_z),
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
                       GEODISK_OFFSET(ControlRec, incomplete),
                       GEODISK_OFFSET(ControlRec, undecided),
                       GEODISK_OFFSET(ControlRec, uncounted),
                       GEODISK_OFFSET(ControlRec, overflow),
                       GEODISK_OFFSET(ControlRec, endless_face),
                       GEODISK_OFFSET(ControlRec, done),
                       GEODISK_OFFSET(ControlRec, below),
                       GEODISK_OFFSET(ControlRec, first_open),
                       GEODISK_OFFSET(ControlRec, ready),
                       GEODISK_OFFSET(ControlRec, accepted),
                       GEODISK_OFFSET(ControlRec, settled),
                       GEODISK_OFFSET(ControlRec, ordered),
                       GEODISK_OFFSET(ControlRec, next_ordered),
                       GEODISK_OFFSET(ControlRec, iterations),
                       GEODISK_OFFSET(ControlRec, steps),
                       GEODISK_OFFSET(ControlRec, disks),
                       GEODISK_OFFSET(ControlRec, windows_low),
                       GEODISK_OFFSET(ControlRec, windows_high),
                       GEODISK_OFFSET(ControlRec, tested_low),
                       GEODISK_OFFSET(ControlRec, tested_high),
                       GEODISK_OFFSET(ControlRec, most_waiting),
                       GEODISK_OFFSET(ControlRec, longest_chain),
                       GEODISK_OFFSET(ControlRec, most_vertices),
                       GEODISK_OFFSET(ControlRec, most_conflicts),
                       GEODISK_OFFSET(ControlRec, trips_low),
                       GEODISK_OFFSET(ControlRec, trips_high),
                       GEODISK_OFFSET(ControlRec, lane_trips_low),
                       GEODISK_OFFSET(ControlRec, lane_trips_high),
                       GEODISK_OFFSET(ControlRec, call_bins),
                       GEODISK_OFFSET(ControlRec, calls_low),
                       GEODISK_OFFSET(ControlRec, calls_high)};

} // namespace

TEST_SUITE("layout") {
    TEST_CASE("push block and control record lie alike in every kernel") {
        std::size_t controls = 0;
        for (std::size_t k = 0; k < kKernels; ++k) {
            const KernelInfo& info = kernel_info(static_cast<Kernel>(k));
            CAPTURE(info.name);
            for (const auto& spirv : {info.words(false), info.words(true)}) {
                const auto offsets = struct_offsets(spirv);
                const bool is_place = static_cast<Kernel>(k) == Kernel::place;
                const char* const push = is_place ? "PlacePush" : "Push";
                REQUIRE(offsets.count(push) == 1);
                CHECK(offsets.at(push) == (is_place ? kPlacePush : kPush));
                if (offsets.count("ControlRec") != 0) {
                    ++controls;
                    CHECK(offsets.at("ControlRec") == kControl);
                    // The blocker words follow the record without a gap.
                    CHECK(offsets.at("control_buffer").at("slots") == sizeof(gpu::ControlRec));
                }
            }
        }
        CHECK(controls == 30);
    }

    TEST_CASE("no kernel binds more than eight storage buffers") {
        for (std::size_t k = 0; k < kKernels; ++k) {
            CAPTURE(kernel_info(static_cast<Kernel>(k)).name);
            for (const bool texels : {false, true}) {
                const auto storage_buffers =
                    std::ranges::count(interface_of(static_cast<Kernel>(k), texels).bindings,
                                       VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, &KernelBinding::type);
                CHECK(storage_buffers >= 1);
                CHECK(storage_buffers <= 8);
            }
        }
    }
}

} // namespace geodisk::test
