#include "engine/kernel_table.hpp"

#include <array>

namespace geodisk {
namespace {

#include "activate.spv.inc"
#include "activate_texels.spv.inc"
#include "bin_fill.spv.inc"
#include "bin_fill_texels.spv.inc"
#include "bin_place.spv.inc"
#include "bin_place_texels.spv.inc"
#include "block.spv.inc"
#include "block_texels.spv.inc"
#include "box_activate.spv.inc"
#include "box_activate_texels.spv.inc"
#include "box_candidates.spv.inc"
#include "box_candidates_texels.spv.inc"
#include "box_fill.spv.inc"
#include "box_fill_texels.spv.inc"
#include "candidates.spv.inc"
#include "candidates_texels.spv.inc"
#include "compact_fill.spv.inc"
#include "compact_fill_texels.spv.inc"
#include "compact_gather.spv.inc"
#include "compact_gather_texels.spv.inc"
#include "compact_mark.spv.inc"
#include "compact_mark_texels.spv.inc"
#include "count_calls.spv.inc"
#include "count_calls_texels.spv.inc"
#include "detect.spv.inc"
#include "detect_texels.spv.inc"
#include "find_idle.spv.inc"
#include "find_idle_texels.spv.inc"
#include "grid_detect.spv.inc"
#include "grid_detect_texels.spv.inc"
#include "resolve.spv.inc"
#include "resolve_texels.spv.inc"
#include "rewind.spv.inc"
#include "rewind_texels.spv.inc"
#include "scan_add.spv.inc"
#include "scan_add_texels.spv.inc"
#include "scan_blocks.spv.inc"
#include "scan_blocks_texels.spv.inc"
#include "scan_sums.spv.inc"
#include "scan_sums_texels.spv.inc"
#include "select.spv.inc"
#include "select_texels.spv.inc"
#include "self_test.spv.inc"
#include "self_test_texels.spv.inc"
#include "space_activate.spv.inc"
#include "space_activate_texels.spv.inc"
#include "space_candidates.spv.inc"
#include "space_candidates_texels.spv.inc"
#include "space_fill.spv.inc"
#include "space_fill_texels.spv.inc"

using namespace gpu;

using enum Access;

constexpr Binding kCandidates[] = {{kBindFaces, read},     {kBindFans, read},
                                   {kBindAlias, read},     {kBindCells, storage},
                                   {kBindPlaces, storage}, {kBindMarks, storage}};
constexpr Binding kScanData[] = {{kBindMarks, storage}, {kBindSums, storage}};
constexpr Binding kScanAdd[] = {{kBindMarks, storage}, {kBindSums, read}};
constexpr Binding kScanSums[] = {{kBindSums, storage}};
constexpr Binding kBinPlace[] = {
    {kBindCells, read}, {kBindWeights, storage}, {kBindPlaces, storage}, {kBindMarks, read}};
constexpr Binding kBinFill[] = {
    {kBindFans, read}, {kBindAlias, read}, {kBindStates, storage}, {kBindWeights, storage}};
constexpr Binding kFindIdle[] = {
    {kBindStates, read}, {kBindPlaces, read}, {kBindControl, storage}, {kBindSums, storage}};
constexpr Binding kSelect[] = {
    {kBindSlots, storage}, {kBindControl, storage}, {kBindSums, read}, {kBindSamples, storage}};
constexpr Binding kActivate[] = {
    {kBindFans, read},     {kBindAlias, read},      {kBindStates, storage}, {kBindPlaces, read},
    {kBindSlots, storage}, {kBindControl, storage}, {kBindMarks, storage}};
constexpr Binding kDetect[] = {
    {kBindFaces, read},   {kBindFans, read},       {kBindCells, read},
    {kBindStates, read},  {kBindWeights, read},    {kBindSlots, storage},
    {kBindPool, storage}, {kBindControl, storage}, {kBindPoolTexels, read_own}};
constexpr Binding kBlock[] = {
    {kBindSlots, storage}, {kBindPool, read}, {kBindControl, storage}, {kBindMarks, read}};
constexpr Binding kResolve[] = {{kBindStates, storage},
                                {kBindSlots, storage},
                                {kBindPool, read},
                                {kBindControl, storage},
                                {kBindMarks, read}};
constexpr Binding kCountCalls[] = {{kBindStates, read},
                                   {kBindSlots, storage},
                                   {kBindPool, read},
                                   {kBindControl, storage},
                                   {kBindMarks, read}};
constexpr Binding kRewind[] = {{kBindStates, storage}, {kBindSlots, read}, {kBindControl, storage}};
constexpr Binding kCompactMark[] = {
    {kBindStates, read}, {kBindPlaces, read}, {kBindControl, storage}, {kBindMarks, storage}};
constexpr Binding kCompactGather[] = {
    {kBindControl, storage}, {kBindMarks, read}, {kBindSamples, storage}};
constexpr Binding kCompactFill[] = {
    {kBindFans, read}, {kBindAlias, read}, {kBindControl, storage}, {kBindSamples, storage}};
constexpr Binding kSelfTest[] = {{kBindSums, storage}};
constexpr Binding kBoxCandidates[] = {
    {kBindAxes, read}, {kBindCells, storage}, {kBindPlaces, storage}, {kBindMarks, storage}};
constexpr Binding kBoxFill[] = {{kBindStates, storage}, {kBindPoints, storage}};
constexpr Binding kSpaceCandidates[] = {{kBindFaces, read},     {kBindAxes, read},
                                        {kBindAlias, read},     {kBindCells, storage},
                                        {kBindPlaces, storage}, {kBindMarks, storage}};
constexpr Binding kSpaceFill[] = {
    {kBindFaces, read}, {kBindAlias, read}, {kBindStates, storage}, {kBindPoints, storage}};
constexpr Binding kBoxActivate[] = {{kBindStates, storage},  {kBindPoints, storage},
                                    {kBindPlaces, read},     {kBindSlots, storage},
                                    {kBindControl, storage}, {kBindMarks, storage}};
constexpr Binding kSpaceActivate[] = {
    {kBindFaces, read},  {kBindAlias, read},    {kBindStates, storage},  {kBindPoints, storage},
    {kBindPlaces, read}, {kBindSlots, storage}, {kBindControl, storage}, {kBindMarks, storage}};
constexpr Binding kGridDetect[] = {
    {kBindAxes, read},     {kBindCells, read},   {kBindStates, read},    {kBindPoints, read},
    {kBindSlots, storage}, {kBindPool, storage}, {kBindControl, storage}};

const std::array<KernelInfo, kKernels> kTable{{
    {"candidates", k_candidates_spirv, k_candidates_texels_spirv, kCandidates, false,
     Domain::surface},
    {"scan_blocks", k_scan_blocks_spirv, k_scan_blocks_texels_spirv, kScanData, false},
    {"scan_sums", k_scan_sums_spirv, k_scan_sums_texels_spirv, kScanSums, false},
    {"scan_add", k_scan_add_spirv, k_scan_add_texels_spirv, kScanAdd, false},
    {"bin_place", k_bin_place_spirv, k_bin_place_texels_spirv, kBinPlace, false},
    {"bin_fill", k_bin_fill_spirv, k_bin_fill_texels_spirv, kBinFill, false, Domain::surface},
    {"find_idle", k_find_idle_spirv, k_find_idle_texels_spirv, kFindIdle, false},
    {"select", k_select_spirv, k_select_texels_spirv, kSelect, true},
    {"activate", k_activate_spirv, k_activate_texels_spirv, kActivate, true, Domain::surface},
    {"detect", k_detect_spirv, k_detect_texels_spirv, kDetect, true, Domain::surface},
    {"block", k_block_spirv, k_block_texels_spirv, kBlock, true},
    {"resolve", k_resolve_spirv, k_resolve_texels_spirv, kResolve, true},
    {"count_calls", k_count_calls_spirv, k_count_calls_texels_spirv, kCountCalls, true},
    {"rewind", k_rewind_spirv, k_rewind_texels_spirv, kRewind, true},
    {"compact_mark", k_compact_mark_spirv, k_compact_mark_texels_spirv, kCompactMark, false},
    {"compact_gather", k_compact_gather_spirv, k_compact_gather_texels_spirv, kCompactGather,
     false},
    {"compact_fill", k_compact_fill_spirv, k_compact_fill_texels_spirv, kCompactFill, false,
     Domain::on_surface},
    {"self_test", k_self_test_spirv, k_self_test_texels_spirv, kSelfTest, false},
    {"box_candidates", k_box_candidates_spirv, k_box_candidates_texels_spirv, kBoxCandidates, false,
     Domain::box},
    {"box_fill", k_box_fill_spirv, k_box_fill_texels_spirv, kBoxFill, false, Domain::box},
    {"space_candidates", k_space_candidates_spirv, k_space_candidates_texels_spirv,
     kSpaceCandidates, false, Domain::space},
    {"space_fill", k_space_fill_spirv, k_space_fill_texels_spirv, kSpaceFill, false, Domain::space},
    {"box_activate", k_box_activate_spirv, k_box_activate_texels_spirv, kBoxActivate, true,
     Domain::box},
    {"space_activate", k_space_activate_spirv, k_space_activate_texels_spirv, kSpaceActivate, true,
     Domain::space},
    {"grid_detect", k_grid_detect_spirv, k_grid_detect_texels_spirv, kGridDetect, true,
     Domain::in_space},
}};

} // namespace

const KernelInfo& kernel_info(Kernel kernel) noexcept {
    return kTable[static_cast<std::size_t>(kernel)];
}

DomainKernels kernels_of(Domain domain) noexcept {
    if (domain == Domain::box) {
        return {Kernel::box_candidates, Kernel::box_fill, Kernel::box_activate,
                Kernel::grid_detect};
    }
    if (domain == Domain::space) {
        return {Kernel::space_candidates, Kernel::space_fill, Kernel::space_activate,
                Kernel::grid_detect};
    }
    return {Kernel::candidates, Kernel::bin_fill, Kernel::activate, Kernel::detect};
}

} // namespace geodisk
