// Settings that are one of a few, and limits of those that are numbers: the one table of their names, for scenes, options, statistics and
// checkpoints.
#pragma once

#include "util/error.h"
#include "util/nearest.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace quasilux {

enum class Variant { main, alternative };      ///< of the law, kernels/law.clh
enum class DirectLight { emitters, photons };  ///< how E0's direct part is estimated
enum class CausticLight { photons, paths };    ///< how E0's caustic part is; see takesCausticsByPaths() in method.h
enum class RadiusChoice { adaptive, fixed };   ///< density radius by pixel, or one for all
enum class Emission { guided, plain };         ///< photons begin by what was learned of the scene, or by power alone
enum class MapOrder { photons, camera };       ///< what is stored and indexed, for the other to find
enum class Units { radiometric, photometric }; ///< of radiance and intensity: W sr^-1 m^-2, or cd/m^2

/// What a choice is called where a name is not known, and the names of its values in their order.
template <typename Choice>
struct ChoiceTable {};
template <>
struct ChoiceTable<Variant> {
    static constexpr const char* what = "variant";
    static constexpr std::array names{"main", "alternative"};
};
template <>
struct ChoiceTable<DirectLight> {
    static constexpr const char* what = "way to estimate direct light";
    static constexpr std::array names{"emitters", "photons"};
};
template <>
struct ChoiceTable<CausticLight> {
    static constexpr const char* what = "way to estimate caustic light";
    static constexpr std::array names{"photons", "paths"};
};
template <>
struct ChoiceTable<RadiusChoice> {
    static constexpr const char* what = "choice of the radius";
    static constexpr std::array names{"adaptive", "fixed"};
};
template <>
struct ChoiceTable<Emission> {
    static constexpr const char* what = "emission";
    static constexpr std::array names{"guided", "plain"};
};
template <>
struct ChoiceTable<MapOrder> {
    static constexpr const char* what = "map";
    static constexpr std::array names{"photons", "camera"};
};
template <>
struct ChoiceTable<Units> {
    static constexpr const char* what = "units";
    static constexpr std::array names{"radiometric", "photometric"};
};

template <typename Choice>
concept NamedChoice = requires {
    ChoiceTable<Choice>::names;
};

template <NamedChoice Choice>
const char* name(Choice choice) {
    return ChoiceTable<Choice>::names.at(static_cast<size_t>(choice));
}

template <NamedChoice Choice>
std::vector<std::string> choiceNames() {
    return {ChoiceTable<Choice>::names.begin(), ChoiceTable<Choice>::names.end()};
}

/// Throws InputError that lists the known names.
template <NamedChoice Choice>
Choice parseChoice(const std::string& text) {
    const auto names = choiceNames<Choice>();
    for (size_t k = 0; k < names.size(); ++k)
        if (names[k] == text) return static_cast<Choice>(k);
    throw InputError("unknown " + std::string(ChoiceTable<Choice>::what) + " '" + text + "', " +
                     expectedNames(text, names));
}

constexpr unsigned bddLimit = 1000, photonsLimit = 1000000000, cameraPathsLimit = 1024;

} // namespace quasilux
