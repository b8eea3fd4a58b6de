// All of the C++ library, for those who do not choose: meshes, domains, and the layers that sample
// them on a device.
// Stable.
#pragma once

#include <geodisk/box.hpp>
#include <geodisk/cells.hpp>
#include <geodisk/context.hpp>
#include <geodisk/count_search.hpp>
#include <geodisk/device.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/farthest.hpp>
#include <geodisk/features.hpp>
#include <geodisk/fields.hpp>
#include <geodisk/frame_neighbours.hpp>
#include <geodisk/frame_sampler.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/kernel_report.hpp>
#include <geodisk/levels.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/nearest.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/params.hpp>
#include <geodisk/placement.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/request.hpp>
#include <geodisk/request_rules.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>
#include <geodisk/update.hpp>
#include <geodisk/version.hpp>
#include <geodisk/weld.hpp>
