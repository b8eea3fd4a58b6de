// Properties that the compiled kernels must have, for every driver to compute the same bits and to
// be given the descriptors that it looks for.
#include <doctest/doctest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "engine/kernels/kernel_table.hpp"
#include "spirv.hpp"

namespace doctest {
template <>
struct StringMaker<std::vector<geodisk::test::DeclaredBinding>> {
    static String convert(const std::vector<geodisk::test::DeclaredBinding>& bindings) {
        std::string text;
        for (const auto& binding : bindings) {
            text += "set " + std::to_string(binding.set) + " binding " +
                    std::to_string(binding.number) + " type " + std::to_string(binding.type) + "; ";
        }
        return text.c_str();
    }
};
} // namespace doctest

namespace geodisk::test {
namespace {

/// Calls visit(kernel, spirv, texels) for both variants of every kernel.
template <class Visit>
void for_each_variant(Visit&& visit) {
    for (std::size_t k = 0; k < kKernels; ++k) {
        const KernelInfo& info = kernel_info(static_cast<Kernel>(k));
        for (const bool texels : {false, true}) {
            const std::string variant = std::string(info.name) + (texels ? " with texels" : "");
            CAPTURE(variant);
            visit(info, info.words(texels), texels);
        }
    }
}

std::vector<DeclaredBinding> bindings_read(std::span<const std::uint32_t> spirv) {
    std::vector<DeclaredBinding> bindings;
    for (const KernelBinding& binding : read_interface(spirv).bindings) {
        bindings.push_back({0, binding.number, binding.type});
    }
    return bindings;
}

/// Takes away the last of the decorations NoContraction.
std::vector<std::uint32_t> without_last_decoration(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t kDecorate = 3u << 16 | 71u, kNoContraction = 42, kNop = 1u << 16;
    std::vector<std::uint32_t> words(spirv.begin(), spirv.end());
    std::size_t last = 0;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
        if (words[at] == kDecorate && words[at + 2] == kNoContraction) {
            last = at;
        }
    }
    REQUIRE(last > 0);
    std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(last), 3, kNop);
    return words;
}

} // namespace

TEST_SUITE("spirv") {
    TEST_CASE("every float operation rounds as written") {
        for_each_variant([](const KernelInfo&, std::span<const std::uint32_t> spirv, bool) {
            for (const LooseOperation& loose : loose_operations(spirv)) {
                FAIL_CHECK("%" << loose.result << " in " << loose.function << ' ' << loose.why);
            }
        });
    }

    TEST_CASE("an operation that lacks its decoration is found") {
        const auto& spirv = kernel_info(Kernel::self_test).spirv;
        const auto spoilt = without_last_decoration(spirv);
        CHECK(loose_operations(spoilt).size() == loose_operations(spirv).size() + 1);
    }

    TEST_CASE("kernels declare the descriptors that the library reads from them") {
        for_each_variant([](const KernelInfo&, std::span<const std::uint32_t> spirv, bool) {
            CHECK(declared_bindings(spirv) == bindings_read(spirv));
        });
    }

    TEST_CASE("kernels have the switches that they are compiled with") {
        const auto has = [](Kernel kernel, std::uint32_t constant) {
            CHECK(interface_of(kernel, true).has_constant(constant) ==
                  interface_of(kernel, false).has_constant(constant));
            return interface_of(kernel, false).has_constant(constant);
        };
        CHECK(has(Kernel::detect, gpu::kSpecManyRows));
        CHECK(has(Kernel::detect, gpu::kSpecLanesApart));
        CHECK(has(Kernel::group_detect, gpu::kSpecGroupLanes));
        CHECK_FALSE(has(Kernel::group_detect, gpu::kSpecPoolBlock));
        CHECK(has(Kernel::draw, gpu::kSpecAdaptive));
        CHECK(has(Kernel::draw, gpu::kSpecManyRows));
        CHECK(has(Kernel::count, gpu::kSpecManyRows));
        CHECK_FALSE(has(Kernel::bin, gpu::kSpecManyRows));
        CHECK(has(Kernel::grid_detect, gpu::kSpecDimension));
        CHECK(has(Kernel::resolve, gpu::kSpecSlotLocalSize));
        CHECK_FALSE(has(Kernel::resolve, gpu::kSpecLocalSize));
        CHECK_FALSE(has(Kernel::count, gpu::kSpecTrims));
        KernelVariant variant;
        variant.trims = variant.adaptive = true;
        CHECK(variant.of(Kernel::detect) == variant);
        CHECK(variant.of(Kernel::count).adaptive);
        CHECK_FALSE(variant.of(Kernel::count).trims);
    }
}

} // namespace geodisk::test
