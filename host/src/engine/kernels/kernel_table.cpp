#include "engine/kernels/kernel_table.hpp"

#include <array>

#include <geodisk/box.hpp>

namespace geodisk {
namespace {

#include "begin_chunk.spv.inc"
#include "bin.spv.inc"
#include "bin_texels.spv.inc"
#include "box_bin.spv.inc"
#include "box_bin_texels.spv.inc"
#include "box_count.spv.inc"
#include "box_count_texels.spv.inc"
#include "box_draw.spv.inc"
#include "box_draw_texels.spv.inc"
#include "box_select.spv.inc"
#include "box_select_texels.spv.inc"
#include "count.spv.inc"
#include "count_calls.spv.inc"
#include "count_orders.spv.inc"
#include "count_texels.spv.inc"
#include "detect.spv.inc"
#include "detect_texels.spv.inc"
#include "draw.spv.inc"
#include "draw_texels.spv.inc"
#include "grid_detect.spv.inc"
#include "grid_detect_texels.spv.inc"
#include "order_count.spv.inc"
#include "order_count_texels.spv.inc"
#include "order_place.spv.inc"
#include "order_place_texels.spv.inc"
#include "order_write.spv.inc"
#include "order_write_texels.spv.inc"
#include "place.spv.inc"
#include "resolve.spv.inc"
#include "resume.spv.inc"
#include "rewind.spv.inc"
#include "scan_blocks.spv.inc"
#include "scan_blocks_texels.spv.inc"
#include "scan_sums.spv.inc"
#include "select.spv.inc"
#include "select_texels.spv.inc"
#include "self_test.spv.inc"
#include "space_bin.spv.inc"
#include "space_bin_texels.spv.inc"
#include "space_count.spv.inc"
#include "space_count_texels.spv.inc"
#include "space_draw.spv.inc"
#include "space_draw_texels.spv.inc"
#include "space_select.spv.inc"
#include "space_select_texels.spv.inc"
#include "sum_blocks.spv.inc"
#include "sum_blocks_texels.spv.inc"

using namespace gpu;

using enum Access;

constexpr Binding kCount[] = {{kBindFaces, read},
                              {kBindFans, read},
                              {kBindKeys, read},
                              {kBindCells, storage},
                              {kBindStarts, storage}};
constexpr Binding kSumBlocks[] = {{kBindCells, read}, {kBindSums, storage}};
constexpr Binding kScanSums[] = {{kBindSums, storage}};
constexpr Binding kScanBlocks[] = {
    {kBindCells, storage}, {kBindSums, read}, {kBindCellsTexels, read_before}};
constexpr Binding kBin[] = {{kBindFaces, read},
                            {kBindFans, read},
                            {kBindKeys, read},
                            {kBindCells, storage},
                            {kBindStarts, read}};
constexpr Binding kDraw[] = {
    {kBindFaces, read},     {kBindFans, read},       {kBindKeys, read},      {kBindCells, storage},
    {kBindStates, storage}, {kBindWeights, storage}, {kBindOrders, storage}, {kBindStarts, read}};
constexpr Binding kBeginChunk[] = {
    {kBindStarts, storage}, {kBindControl, storage}, {kBindList, storage}};
constexpr Binding kSelect[] = {{kBindStates, storage},          {kBindWeights, read},
                               {kBindOrders, storage},          {kBindStarts, read},
                               {kBindControl, storage},         {kBindList, storage},
                               {kBindSamples, storage},         {kBindStatesTexels, read_before},
                               {kBindOrdersTexels, read_before}};
constexpr Binding kDetect[] = {
    {kBindFaces, read},   {kBindFans, read},       {kBindCells, read},
    {kBindStates, read},  {kBindWeights, read},    {kBindOrders, read},
    {kBindPool, storage}, {kBindControl, storage}, {kBindPoolTexels, read_own}};
constexpr Binding kResolve[] = {{kBindStates, storage}, {kBindOrders, storage},
                                {kBindPool, storage},   {kBindControl, storage},
                                {kBindList, storage},   {kBindAccepted, storage}};
constexpr Binding kCountCalls[] = {
    {kBindOrders, storage}, {kBindPool, storage}, {kBindControl, storage}, {kBindList, storage}};
constexpr Binding kRewind[] = {
    {kBindStates, storage}, {kBindOrders, storage}, {kBindControl, storage}};
constexpr Binding kResume[] = {{kBindControl, storage}, {kBindList, storage}};
constexpr Binding kCountOrders[] = {{kBindOrders, storage}, {kBindControl, storage}};
constexpr Binding kOrderCount[] = {
    {kBindControl, storage}, {kBindAccepted, read}, {kBindBuckets, storage}};
constexpr Binding kOrderPlace[] = {
    {kBindControl, storage}, {kBindAccepted, read}, {kBindBuckets, storage}};
constexpr Binding kOrderWrite[] = {
    {kBindControl, storage}, {kBindSamples, storage}, {kBindAccepted, read}, {kBindBuckets, read}};
constexpr Binding kPlace[] = {{kBindFans, storage},     {kBindKeys, storage},
                              {kBindControl, storage},  {kBindSamples, storage},
                              {kBindVertices, storage}, {kBindIndices, storage},
                              {kBindPlaced, storage},   {kBindArguments, storage}};
constexpr Binding kSelfTest[] = {{kBindSums, storage}};
constexpr Binding kBoxCount[] = {{kBindAxes, read}, {kBindStarts, storage}};
constexpr Binding kBoxBin[] = {{kBindAxes, read}, {kBindCells, storage}, {kBindStarts, read}};
constexpr Binding kBoxDraw[] = {{kBindAxes, read},      {kBindCells, storage},
                                {kBindStates, storage}, {kBindPoints, storage},
                                {kBindOrders, storage}, {kBindStarts, read}};
constexpr Binding kBoxSelect[] = {{kBindAxes, read},
                                  {kBindStates, storage},
                                  {kBindPoints, storage},
                                  {kBindOrders, storage},
                                  {kBindStarts, read},
                                  {kBindControl, storage},
                                  {kBindList, storage},
                                  {kBindSamples, storage},
                                  {kBindStatesTexels, read_before},
                                  {kBindOrdersTexels, read_before}};
constexpr Binding kSpaceCount[] = {{kBindFaces, read}, {kBindStarts, storage}};
constexpr Binding kSpaceBin[] = {
    {kBindFaces, read}, {kBindAxes, read}, {kBindCells, storage}, {kBindStarts, read}};
constexpr Binding kSpaceDraw[] = {
    {kBindFaces, read},     {kBindAxes, read},      {kBindCells, storage}, {kBindStates, storage},
    {kBindPoints, storage}, {kBindOrders, storage}, {kBindStarts, read}};
constexpr Binding kSpaceSelect[] = {{kBindFaces, read},
                                    {kBindStates, storage},
                                    {kBindPoints, storage},
                                    {kBindOrders, storage},
                                    {kBindStarts, read},
                                    {kBindControl, storage},
                                    {kBindList, storage},
                                    {kBindSamples, storage},
                                    {kBindStatesTexels, read_before},
                                    {kBindOrdersTexels, read_before}};
constexpr Binding kGridDetect[] = {
    {kBindAxes, read},   {kBindCells, read},   {kBindStates, read},    {kBindPoints, read},
    {kBindOrders, read}, {kBindPool, storage}, {kBindControl, storage}};

const std::array<KernelInfo, kKernels> kTable{{
    {"count", k_count_spirv, kCount, false, DomainKind::surface, k_count_texels_spirv},
    {"sum_blocks", k_sum_blocks_spirv, kSumBlocks, false, DomainKind::any,
     k_sum_blocks_texels_spirv},
    {"scan_sums", k_scan_sums_spirv, kScanSums, false},
    {"scan_blocks", k_scan_blocks_spirv, kScanBlocks, false, DomainKind::any,
     k_scan_blocks_texels_spirv},
    {"bin", k_bin_spirv, kBin, false, DomainKind::surface, k_bin_texels_spirv},
    {"draw", k_draw_spirv, kDraw, false, DomainKind::surface, k_draw_texels_spirv},
    {"begin_chunk", k_begin_chunk_spirv, kBeginChunk, true},
    {"select", k_select_spirv, kSelect, true, DomainKind::surface, k_select_texels_spirv},
    {"detect", k_detect_spirv, kDetect, true, DomainKind::surface, k_detect_texels_spirv},
    {"resolve", k_resolve_spirv, kResolve, true},
    {"count_calls", k_count_calls_spirv, kCountCalls, true},
    {"rewind", k_rewind_spirv, kRewind, true},
    {"resume", k_resume_spirv, kResume, true},
    {"count_orders", k_count_orders_spirv, kCountOrders, false},
    {"order_count", k_order_count_spirv, kOrderCount, false, DomainKind::any,
     k_order_count_texels_spirv},
    {"order_place", k_order_place_spirv, kOrderPlace, false, DomainKind::any,
     k_order_place_texels_spirv},
    {"order_write", k_order_write_spirv, kOrderWrite, false, DomainKind::any,
     k_order_write_texels_spirv},
    {"place", k_place_spirv, kPlace, false, DomainKind::placement},
    {"self_test", k_self_test_spirv, kSelfTest, false},
    {"box_count", k_box_count_spirv, kBoxCount, false, DomainKind::box, k_box_count_texels_spirv},
    {"box_bin", k_box_bin_spirv, kBoxBin, false, DomainKind::box, k_box_bin_texels_spirv},
    {"box_draw", k_box_draw_spirv, kBoxDraw, false, DomainKind::box, k_box_draw_texels_spirv},
    {"box_select", k_box_select_spirv, kBoxSelect, true, DomainKind::box,
     k_box_select_texels_spirv},
    {"space_count", k_space_count_spirv, kSpaceCount, false, DomainKind::space,
     k_space_count_texels_spirv},
    {"space_bin", k_space_bin_spirv, kSpaceBin, false, DomainKind::space, k_space_bin_texels_spirv},
    {"space_draw", k_space_draw_spirv, kSpaceDraw, false, DomainKind::space,
     k_space_draw_texels_spirv},
    {"space_select", k_space_select_spirv, kSpaceSelect, true, DomainKind::space,
     k_space_select_texels_spirv},
    {"grid_detect", k_grid_detect_spirv, kGridDetect, true, DomainKind::in_space,
     k_grid_detect_texels_spirv},
}};

} // namespace

KernelVariant KernelVariant::of(Kernel kernel) const noexcept {
    KernelVariant variant = *this;
    if (kernel != Kernel::detect) {
        variant.many_rows = false;
        variant.event_heap = false;
        variant.trims = false;
        variant.lanes_apart = false;
    }
    return variant;
}

std::vector<KernelVariant> all_kernel_variants() {
    std::vector<KernelVariant> variants;
    for (const bool adaptive : {false, true}) {
        for (const bool many_rows : {false, true}) {
            KernelVariant surface;
            surface.adaptive = adaptive;
            surface.many_rows = many_rows;
            variants.push_back(surface);
            for (bool KernelVariant::*const also :
                 {&KernelVariant::event_heap, &KernelVariant::trims, &KernelVariant::lanes_apart,
                  &KernelVariant::several}) {
                variants.emplace_back(surface).*also = true;
            }
        }
        for (const bool of_several : {false, true}) {
            KernelVariant& placement = variants.emplace_back();
            placement.domain = DomainKind::placement;
            placement.adaptive = adaptive;
            placement.several = of_several;
        }
    }
    for (std::uint32_t dimension = 1; dimension <= kMostBoxDimensions; ++dimension) {
        KernelVariant& variant = variants.emplace_back();
        variant.domain = DomainKind::box;
        variant.dimension = dimension;
    }
    for (const bool curved : {false, true}) {
        KernelVariant& variant = variants.emplace_back();
        variant.domain = DomainKind::space;
        variant.dimension = 3;
        variant.curved = curved;
    }
    return variants;
}

const KernelInfo& kernel_info(Kernel kernel) noexcept {
    return kTable[static_cast<std::size_t>(kernel)];
}

DomainKernels kernels_of(DomainKind domain) noexcept {
    if (domain == DomainKind::box) {
        return {Kernel::box_count, Kernel::box_bin, Kernel::box_draw, Kernel::box_select,
                Kernel::grid_detect};
    }
    if (domain == DomainKind::space) {
        return {Kernel::space_count, Kernel::space_bin, Kernel::space_draw, Kernel::space_select,
                Kernel::grid_detect};
    }
    return {Kernel::count, Kernel::bin, Kernel::draw, Kernel::select, Kernel::detect};
}

} // namespace geodisk
