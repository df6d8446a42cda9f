// Finds the plugin that an element names in the table of its kind.
#pragma once

#include "scene/load_context.h"
#include "scene/unsupported_plugins.h"
#include "scene/xml/element.h"
#include "scene/xml/names.h"

#include <cstddef>
#include <fmt/format.h>

namespace quasilux {

/// What to use instead of a plugin that Mitsuba has; of others that they are unknown.
inline std::string aboutUnknownPlugin(const Element& element) {
    const std::string& plugin = element.get("type");
    const std::string_view instead = insteadOfUnsupported(element.tag, plugin);
    return instead.empty() ? fmt::format("unknown {} plugin '{}'.", element.tag, plugin)
                           : fmt::format("{} '{}' is not supported: {}.", element.tag, plugin, instead);
}

/// Throws InputError with what to use instead of a plugin that Mitsuba has, or else with the nearest of the `known`
/// ones.
[[noreturn]] inline void throwUnknownPlugin(const Element& element, const Names& known) {
    const std::string& plugin = element.get("type");
    const bool isOfMitsuba = !insteadOfUnsupported(element.tag, plugin).empty();
    throw InputError(element.where,
                     aboutUnknownPlugin(element) + (isOfMitsuba ? std::string() : knownNames(plugin, known)));
}

/// All of the table, and `others`, which are known besides.
template <typename Plugin, size_t count>
Names namesOf(const Plugin (&plugins)[count], const Names& others = {}) {
    Names names = others;
    for (const Plugin& plugin : plugins) names.push_back(plugin.name);
    return names;
}

/// The row of `plugins` whose `name` is the element's type. Throws InputError with the nearest name if there is none,
/// of `others` too, which are known besides.
template <typename Plugin, size_t count>
const Plugin& findPlugin(const Plugin (&plugins)[count], const Element& element, const Names& others = {}) {
    for (const Plugin& plugin : plugins)
        if (plugin.name == element.get("type")) return plugin;
    throwUnknownPlugin(element, namesOf(plugins, others));
}

/// The same, or nullptr where the unknown is forgiven; `instead` is what the caller does then.
template <typename Plugin, size_t count>
const Plugin* findPlugin(const Plugin (&plugins)[count], const Element& element, LoadContext& context,
                         const std::string& instead, const Names& others = {}) {
    try {
        return &findPlugin(plugins, element, others);
    } catch (const InputError&) {
        if (context.unknown == Unknown::refused) throw;
    }
    context.refuseUnknown(element.where, aboutUnknownPlugin(element), instead);
    return nullptr;
}

} // namespace quasilux
