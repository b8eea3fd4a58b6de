#include <geodisk/count_search.hpp>

#include <geodisk/params.hpp>

#include "c/c_call.hpp"

struct geodisk_count_search {
    geodisk::CountSearch search;
};

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_count_search_create(double wanted, geodisk_count_search** search,
                                           geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (search == nullptr) {
            return wrong("search is NULL");
        }
        if (!(wanted >= 1) || !(wanted <= kMaxCandidates)) {
            return wrong("wanted is not from 1 to 4294967295");
        }
        *search = new geodisk_count_search{CountSearch(wanted)};
        return Done{};
    });
}

geodisk_status geodisk_count_search_create_exact(uint64_t count, geodisk_count_search** search,
                                                 geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (search == nullptr) {
            return wrong("search is NULL");
        }
        if (count == 0 || count > kMaxCandidates) {
            return wrong("count is not from 1 to 4294967295");
        }
        *search = new geodisk_count_search{CountSearch::exact(count)};
        return Done{};
    });
}

geodisk_status geodisk_count_search_note(geodisk_count_search* search, double distance,
                                         uint64_t count, double* next, int32_t* is_nearest,
                                         geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (search == nullptr || next == nullptr || is_nearest == nullptr) {
            return wrong("search, next or is_nearest is NULL");
        }
        if (!(distance > 0)) {
            return wrong("distance is not positive");
        }
        *next = search->search.note(distance, count).value_or(0);
        *is_nearest = search->search.is_nearest() ? 1 : 0;
        return Done{};
    });
}

void geodisk_count_search_release(geodisk_count_search* search) {
    delete search;
}

} // extern "C"
