// Settings that are one of a few, and limits of those that are numbers: the one table of their names, for scenes,
// options, statistics and checkpoints.
#pragma once

#include "util/error.h"
#include "util/nearest.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quasilux {

enum class Variant { main, alternative };     ///< of the law, kernels/law.clh
enum class DirectLight { emitters, photons }; ///< how E0's direct part is estimated
enum class CausticLight { photons, paths };   ///< how E0's caustic part is; see takesCausticsByPaths() in method.h
enum class RadiusChoice { adaptive, fixed };  ///< density radius by pixel, or one for all
enum class Emission { guided, plain };        ///< photons begin by what was learned of the scene, or by power alone
enum class CameraSampling { even, adaptive }; ///< camera paths of all pixels alike, or more where they are noisy
enum class MapOrder { photons, camera };      ///< what is stored and indexed, for the other to find
enum class InstanceLevels { one, two }; ///< shapes of an instance are flattened, or a level of the tree of their own
enum class Units { radiometric, photometric }; ///< of radiance and intensity: W sr^-1 m^-2, or cd/m^2

/// What a choice is called where a name is not known, and the names of its values in their order.
struct ChoiceWords {
    const char* what = nullptr;
    std::array<const char*, 2> names{};
};
template <typename Choice>
inline constexpr ChoiceWords choiceWords{};
template <>
inline constexpr ChoiceWords choiceWords<Variant>{"variant", {"main", "alternative"}};
template <>
inline constexpr ChoiceWords choiceWords<DirectLight>{"way to estimate direct light", {"emitters", "photons"}};
template <>
inline constexpr ChoiceWords choiceWords<CausticLight>{"way to estimate caustic light", {"photons", "paths"}};
template <>
inline constexpr ChoiceWords choiceWords<RadiusChoice>{"choice of the radius", {"adaptive", "fixed"}};
template <>
inline constexpr ChoiceWords choiceWords<Emission>{"emission", {"guided", "plain"}};
template <>
inline constexpr ChoiceWords choiceWords<CameraSampling>{"way to sample pixels", {"even", "adaptive"}};
template <>
inline constexpr ChoiceWords choiceWords<MapOrder>{"map", {"photons", "camera"}};
template <>
inline constexpr ChoiceWords choiceWords<InstanceLevels>{"treatment of instances", {"flattened", "two-level"}};
template <>
inline constexpr ChoiceWords choiceWords<Units>{"units", {"radiometric", "photometric"}};

template <typename Choice>
concept NamedChoice = choiceWords<Choice>
.what != nullptr;

template <NamedChoice Choice>
const char* name(Choice choice) {
    return choiceWords<Choice>.names.at(static_cast<size_t>(choice));
}

template <NamedChoice Choice>
std::vector<std::string> choiceNames() {
    return {choiceWords<Choice>.names.begin(), choiceWords<Choice>.names.end()};
}

template <NamedChoice Choice>
std::optional<Choice> findChoice(std::string_view text) {
    const auto& names = choiceWords<Choice>.names;
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return std::nullopt;
    return static_cast<Choice>(found - names.begin());
}

/// Throws InputError that lists the known names.
template <NamedChoice Choice>
Choice parseChoice(const std::string& text) {
    if (const auto found = findChoice<Choice>(text)) return *found;
    throw InputError("unknown " + std::string(choiceWords<Choice>.what) + " '" + text + "', " +
                     expectedNames(text, choiceNames<Choice>()));
}

constexpr unsigned bddLimit = 1000, photonsLimit = 1000000000, cameraPathsLimit = 1024;

} // namespace quasilux
