#include "engine/kernel_table.hpp"

#include <array>

namespace geodisk {
namespace {

#include "activate.spv.inc"
#include "bin_fill.spv.inc"
#include "block.spv.inc"
#include "candidates.spv.inc"
#include "compact_fill.spv.inc"
#include "compact_gather.spv.inc"
#include "compact_mark.spv.inc"
#include "detect.spv.inc"
#include "find_idle.spv.inc"
#include "resolve.spv.inc"
#include "rewind.spv.inc"
#include "scan_add.spv.inc"
#include "scan_blocks.spv.inc"
#include "scan_sums.spv.inc"
#include "select.spv.inc"
#include "self_test.spv.inc"

using namespace gpu;

constexpr std::uint32_t kCandidates[] = {kBindFaces, kBindAlias, kBindCells, kBindPlaces,
                                         kBindMarks};
constexpr std::uint32_t kScanData[] = {kBindMarks, kBindSums};
constexpr std::uint32_t kScanSums[] = {kBindSums};
constexpr std::uint32_t kBinFill[] = {kBindAlias,   kBindCells,  kBindStates,
                                      kBindWeights, kBindPlaces, kBindMarks};
constexpr std::uint32_t kFindIdle[] = {kBindStates, kBindPlaces, kBindControl, kBindSums};
constexpr std::uint32_t kSelect[] = {kBindSlots, kBindControl, kBindSums};
constexpr std::uint32_t kActivate[] = {kBindAlias, kBindStates,  kBindPlaces,
                                       kBindSlots, kBindControl, kBindMarks};
constexpr std::uint32_t kDetect[] = {kBindFaces,   kBindFans,  kBindCells, kBindStates,
                                     kBindWeights, kBindSlots, kBindPool,  kBindControl};
constexpr std::uint32_t kBlock[] = {kBindSlots, kBindPool, kBindControl, kBindMarks};
constexpr std::uint32_t kResolve[] = {kBindStates, kBindSlots, kBindPool, kBindControl, kBindMarks};
constexpr std::uint32_t kRewind[] = {kBindStates, kBindSlots, kBindControl};
constexpr std::uint32_t kCompactMark[] = {kBindStates, kBindPlaces, kBindControl, kBindMarks};
constexpr std::uint32_t kCompactGather[] = {kBindControl, kBindMarks, kBindSamples};
constexpr std::uint32_t kCompactFill[] = {kBindAlias, kBindControl, kBindSamples};
constexpr std::uint32_t kSelfTest[] = {kBindSums};

const std::array<KernelInfo, kKernels> kTable{{
    {"candidates", k_candidates_spirv, kCandidates, false},
    {"scan_blocks", k_scan_blocks_spirv, kScanData, false},
    {"scan_sums", k_scan_sums_spirv, kScanSums, false},
    {"scan_add", k_scan_add_spirv, kScanData, false},
    {"bin_fill", k_bin_fill_spirv, kBinFill, false},
    {"find_idle", k_find_idle_spirv, kFindIdle, false},
    {"select", k_select_spirv, kSelect, true},
    {"activate", k_activate_spirv, kActivate, true},
    {"detect", k_detect_spirv, kDetect, true},
    {"block", k_block_spirv, kBlock, true},
    {"resolve", k_resolve_spirv, kResolve, true},
    {"rewind", k_rewind_spirv, kRewind, true},
    {"compact_mark", k_compact_mark_spirv, kCompactMark, false},
    {"compact_gather", k_compact_gather_spirv, kCompactGather, false},
    {"compact_fill", k_compact_fill_spirv, kCompactFill, false},
    {"self_test", k_self_test_spirv, kSelfTest, false},
}};

} // namespace

const KernelInfo& kernel_info(Kernel kernel) noexcept {
    return kTable[static_cast<std::size_t>(kernel)];
}

} // namespace geodisk
