// Layouts that programs compiled with this version rely on. Fields may be added at the end of a
// struct; none may move.
#include <doctest/doctest.h>

#include <cstddef>

#include <geodisk/geodisk.h>

#define CHECK_FIELD(Struct, field, offset)                                                         \
    static_assert(sizeof(void*) != 8 || offsetof(Struct, field) == (offset))

CHECK_FIELD(geodisk_error, status, 8);
CHECK_FIELD(geodisk_error, element, 16);
CHECK_FIELD(geodisk_error, message, 24);
CHECK_FIELD(geodisk_device_info, compute_queue_family, 32);
CHECK_FIELD(geodisk_device_info, memory_bytes, 40);
CHECK_FIELD(geodisk_device_info, uuid, 48);
CHECK_FIELD(geodisk_device_info, name, 64);
CHECK_FIELD(geodisk_device_info, driver, 320);
CHECK_FIELD(geodisk_device_info, reasons, 832);
CHECK_FIELD(geodisk_device_options, device, 8);
CHECK_FIELD(geodisk_device_options, validation, 16);
CHECK_FIELD(geodisk_device_options, keep_pipelines, 20);
CHECK_FIELD(geodisk_vulkan_device, get_instance_proc_addr, 32);
CHECK_FIELD(geodisk_vulkan_device, queue, 48);
CHECK_FIELD(geodisk_vulkan_device, pipeline_cache, 56);
CHECK_FIELD(geodisk_vulkan_device, lock_user, 72);
CHECK_FIELD(geodisk_vulkan_device, host_allocator, 96);
CHECK_FIELD(geodisk_vulkan_device, memory_user, 104);
CHECK_FIELD(geodisk_vulkan_device, free, 120);
CHECK_FIELD(geodisk_memory_request, bytes, 16);
CHECK_FIELD(geodisk_memory_request, preferred, 40);
CHECK_FIELD(geodisk_memory_grant, allocation, 32);
CHECK_FIELD(geodisk_mesh_params, vertex_count, 24);
CHECK_FIELD(geodisk_mesh_params, indices, 40);
CHECK_FIELD(geodisk_mesh_params, face_count, 56);
CHECK_FIELD(geodisk_mesh_params, edge_lengths, 72);
CHECK_FIELD(geodisk_mesh_params, weld_distance, 88);
CHECK_FIELD(geodisk_mesh_params, max_threads, 96);
CHECK_FIELD(geodisk_mesh_params, keep_seams, 100);
CHECK_FIELD(geodisk_mesh_info, faces, 24);
CHECK_FIELD(geodisk_mesh_info, merged_vertices, 80);
CHECK_FIELD(geodisk_mesh_info, longest_edge, 104);
CHECK_FIELD(geodisk_mesh_info, joined_edges, 112);
CHECK_FIELD(geodisk_surface_params, min_distance, 8);
CHECK_FIELD(geodisk_surface_params, darts, 32);
CHECK_FIELD(geodisk_surface_params, radii, 40);
CHECK_FIELD(geodisk_surface_params, metric, 56);
CHECK_FIELD(geodisk_surface_params, face_mask, 64);
CHECK_FIELD(geodisk_surface_params, existing, 72);
CHECK_FIELD(geodisk_surface_params, existing_count, 80);
CHECK_FIELD(geodisk_surface_params, avoid, 88);
CHECK_FIELD(geodisk_surface_params, avoid_count, 104);
CHECK_FIELD(geodisk_surface_params, class_factors, 112);
CHECK_FIELD(geodisk_surface_params, existing_classes, 128);
CHECK_FIELD(geodisk_surface_params, is_maximal, 136);
CHECK_FIELD(geodisk_surface_params, avoid_classes, 144);
CHECK_FIELD(geodisk_surface_params, class_shares, 152);
CHECK_FIELD(geodisk_surface_point, weights, 4);
CHECK_FIELD(geodisk_surface_part, scale, 24);
CHECK_FIELD(geodisk_neighbour_params, source_count, 24);
CHECK_FIELD(geodisk_neighbour_params, within, 32);
CHECK_FIELD(geodisk_neighbour_params, kind, 48);
CHECK_FIELD(geodisk_neighbour_params, points, 56);
CHECK_FIELD(geodisk_neighbour_params, nearest, 72);
CHECK_FIELD(geodisk_neighbour_params, max_pairs, 80);
CHECK_FIELD(geodisk_neighbour_params, joined, 88);
CHECK_FIELD(geodisk_neighbour_arrays, vertices, 24);
CHECK_FIELD(geodisk_neighbour_arrays, distances, 48);
CHECK_FIELD(geodisk_neighbour_arrays, error, 56);
CHECK_FIELD(geodisk_cell_params, areas_only, 24);
CHECK_FIELD(geodisk_cell_params, max_records, 32);
CHECK_FIELD(geodisk_cell_arrays, areas, 32);
CHECK_FIELD(geodisk_cell_arrays, area_error, 56);
CHECK_FIELD(geodisk_cell_arrays, manifold_triangles, 80);
CHECK_FIELD(geodisk_farthest_info, cover, 8);
CHECK_FIELD(geodisk_farthest_info, searches, 24);
CHECK_FIELD(geodisk_update_info, uploaded, 16);
CHECK_FIELD(geodisk_update_info, disks, 28);
CHECK_FIELD(geodisk_box_params, min_distance, 24);
CHECK_FIELD(geodisk_box_params, stop_count, 52);
CHECK_FIELD(geodisk_sampler_options, stall_seconds, 24);
CHECK_FIELD(geodisk_progress, windows, 24);
CHECK_FIELD(geodisk_report, windows, 32);
CHECK_FIELD(geodisk_report, rho, 64);
CHECK_FIELD(geodisk_report, missing, 104);
CHECK_FIELD(geodisk_report, existing, 108);
CHECK_FIELD(geodisk_report, maximal_rounds, 112);
CHECK_FIELD(geodisk_report, largest_gap, 128);
CHECK_FIELD(geodisk_report, tries, 136);
CHECK_FIELD(geodisk_report, level_factor, 144);
CHECK_FIELD(geodisk_report, cut, 152);
CHECK_FIELD(geodisk_report, lacks_features, 176);
CHECK_FIELD(geodisk_report, cover, 184);
CHECK_FIELD(geodisk_request, params, 8);
CHECK_FIELD(geodisk_request, is_exact, 24);
CHECK_FIELD(geodisk_request, order, 28);
CHECK_FIELD(geodisk_request, features, 32);
CHECK_FIELD(geodisk_request, levels, 48);
CHECK_FIELD(geodisk_request, keep, 52);
CHECK_FIELD(geodisk_job_options, regrowths, 20);
CHECK_FIELD(geodisk_buffer_need, read_bytes, 24);
CHECK_FIELD(geodisk_buffer_range, bytes, 16);
CHECK_FIELD(geodisk_advice, ready, 12);
CHECK_FIELD(geodisk_advice, candidates, 16);
CHECK_FIELD(geodisk_frame_options, frames, 16);
CHECK_FIELD(geodisk_frame_options, reader_access, 36);
CHECK_FIELD(geodisk_frame_samples, placed_offset, 16);
CHECK_FIELD(geodisk_frame_samples, is_complete, 48);
CHECK_FIELD(geodisk_placement_params, has_normals, 40);
CHECK_FIELD(geodisk_placement_params, indices, 48);
CHECK_FIELD(geodisk_placement_params, placed, 80);
CHECK_FIELD(geodisk_placement_params, arguments, 104);
