#include "c/c_request.hpp"

#include <span>
#include <string>
#include <utility>

#include "c/c_call.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

Result<SampleOrder> order_of(geodisk_order given) {
    switch (given) {
    case GEODISK_ORDER_DART:
        return SampleOrder::dart;
    case GEODISK_ORDER_PROGRESSIVE:
        return SampleOrder::progressive;
    case GEODISK_ORDER_FARTHEST:
        return SampleOrder::farthest;
    default:
        return wrong("request->order is none of the three");
    }
}

} // namespace

Result<std::shared_ptr<RequestState>> request_of(const geodisk_mesh* mesh,
                                                 const geodisk_request* request) {
    const auto given = taken(request, "request");
    GEODISK_TRY(given);
    auto state = std::make_shared<RequestState>();
    state->of = std::make_shared<DomainState>();
    state->of->parts.resize(1);
    Part& part = state->of->parts[0];
    const auto params = fill_part(mesh, given->params, part);
    GEODISK_TRY(params);
    const auto order = order_of(given->order);
    GEODISK_TRY(order);
    SampleRequest& wanted = state->request;
    wanted.params = part.params;
    wanted.count = given->count;
    wanted.is_exact = given->is_exact != 0;
    wanted.features = given->features;
    wanted.at_vertices = given->at_vertices != 0;
    wanted.order = *order;
    wanted.levels.count = given->levels;
    wanted.levels.factor = given->level_factor != 0 ? given->level_factor : kLevelFactor;
    wanted.keep = given->keep;
    if (given->class_counts != nullptr) {
        if (params->class_count == 0) {
            return wrong("request->class_counts is for classes, and params->class_count is 0");
        }
        state->class_counts.assign(given->class_counts, given->class_counts + params->class_count);
        wanted.class_counts = state->class_counts;
    }
    if (params->metric != GEODISK_GEODESIC) {
        const auto metric = metric_of(params->metric);
        GEODISK_TRY(metric);
        wanted.metric = *metric;
    }
    if (part.mesh->dimension != 0) {
        state->view = part.mesh->view();
        wanted.view = &state->view;
    }
    return state;
}

Result<std::shared_ptr<RequestsState>> requests_of(const geodisk_mesh_request* requests,
                                                   std::size_t count) {
    if (requests == nullptr || count == 0) {
        return wrong("there are no requests");
    }
    auto state = std::make_shared<RequestsState>();
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = "requests[" + std::to_string(i) + "]";
        const auto given = taken(element_of(requests, i), name.c_str());
        GEODISK_TRY(given);
        auto made = request_of(given->mesh, given->request);
        if (!made) {
            return count > 1 ? wrong(name + ": " + made.error().message) : made.error();
        }
        state->each.push_back(std::move(*made));
    }
    return state;
}

std::vector<MeshRequest> RequestsState::on_meshes() const {
    std::vector<MeshRequest> requests;
    for (const auto& one : each) {
        requests.push_back({&one->of->parts[0].mesh->prepared, one->request});
    }
    return requests;
}

Result<std::shared_ptr<RequestsState>> requests_of(const geodisk_box_request* request) {
    const auto given = taken(request, "request");
    GEODISK_TRY(given);
    auto box = box_of(given->params);
    GEODISK_TRY(box);
    auto one = std::make_shared<RequestState>();
    one->of = std::make_shared<DomainState>();
    one->box = {std::move(*box), given->count, given->is_exact != 0};
    auto state = std::make_shared<RequestsState>();
    state->each.push_back(std::move(one));
    return state;
}

Result<StartedRequests> RequestsState::start(Runner& runner,
                                             const ProgressCallback& progress) const {
    const RequestState& first = *each[0];
    return first.of->is_box() ? StartedRequests::start(runner, first.box, progress)
                              : StartedRequests::start(runner, on_meshes(), progress);
}

Result<std::vector<RequestedSet>> RequestsState::sample(Runner& runner,
                                                        const ProgressCallback& progress) const {
    if (!each[0]->of->is_box()) {
        return geodisk::sample(runner, on_meshes(), progress);
    }
    auto found = geodisk::sample(runner, each[0]->box, progress);
    GEODISK_TRY(found);
    std::vector<RequestedSet> all;
    all.push_back(std::move(*found));
    return all;
}

Result<std::shared_ptr<const DomainState>> at_found_distance(RequestState& state,
                                                             const RequestedSet& found) {
    state.of->min_distance = found.min_distance;
    if (!state.of->is_box()) {
        state.of->parts[0].params.min_distance = found.min_distance;
        return std::shared_ptr<const DomainState>(state.of);
    }
    state.box.params.min_distance = found.min_distance;
    auto domain = Domain::box(state.box.params);
    GEODISK_TRY(domain);
    state.of->domain = std::move(*domain);
    return std::shared_ptr<const DomainState>(state.of);
}

} // namespace geodisk::c

extern "C" {

geodisk_status geodisk_request_rule(size_t number, geodisk_rule* rule, geodisk_error* error) {
    using namespace geodisk;
    return c::answer(error, [&]() -> Result<Done> {
        const std::span<const RequestRule> rules = request_rules();
        if (number >= rules.size()) {
            return c::wrong("there are " + std::to_string(rules.size()) + " rules");
        }
        const auto& [field, other, reason] = rules[number];
        return c::give(rule, "rule", {0, to_string(field), to_string(other), reason});
    });
}

} // extern "C"
