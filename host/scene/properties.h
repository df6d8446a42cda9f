// The parameters and nested objects of one plugin element. What is not asked for is an error.
#pragma once

#include "scene/color.h"
#include "scene/load_context.h"
#include "scene/xml/names.h"

#include <glm/glm.hpp>
#include <map>
#include <set>

namespace quasilux {

/// Every query marks a parameter as known; finish() refuses the ones nobody asked for. All throw InputError at the
/// parameter's place for a wrong type or a value that cannot be read; of values out of range, where that is forgiven,
/// the nearest is taken, if there is one.
class Properties {
public:
    Properties(const Element& element, LoadContext& context);

    const Element& element() const { return element_; }
    LoadContext& context() const { return context_; }
    const std::string& plugin() const { return element_.get("type"); }
    /// "bsdf 'diffuse'", for messages.
    std::string describe() const;
    /// The parameter's place, or the object's where it is not given.
    SourceLocation where(const std::string& name) const;
    bool has(const std::string& name);

    double number(const std::string& name, double missing);
    /// The same of what may be a texture in Mitsuba: of a colour the mean of its channels, as there.
    double textureNumber(const std::string& name, double missing);
    /// A number of at least `lowest` (greater than it where `open`).
    double numberAbove(const std::string& name, double missing, double lowest, bool open);
    /// A number within [0, 1].
    double share(const std::string& name, double missing);
    /// A number from `lowest` to `highest`.
    double numberWithin(const std::string& name, double missing, double lowest, double highest);
    int64_t integer(const std::string& name, int64_t missing);
    int integerWithin(const std::string& name, int missing, int lowest, int highest);
    bool boolean(const std::string& name, bool missing);
    std::string string(const std::string& name, const std::string& missing);
    /// One of `known`, or InputError with the nearest name.
    std::string choice(const std::string& name, const std::string& missing, const Names& known);
    /// The same where capital letters do not matter to Mitsuba.
    std::string choiceOfAnyCase(const std::string& name, const std::string& missing, const Names& known);
    glm::dvec3 vector(const std::string& name, const glm::dvec3& missing);
    /// As `vector`, of length 1. A vector of no length is refused.
    glm::dvec3 direction(const std::string& name, const glm::dvec3& missing);
    /// Unity where it is missing. What `to_world` leads to is relative to Scene::origin.
    glm::dmat4 transform(const std::string& name);
    /// The same without the part of an instance, and without Scene::origin: as the file states it.
    glm::dmat4 ownTransform(const std::string& name);
    /// What `to_world` has beside that.
    glm::dmat4 placement() const;
    /// Channels within [0, 1].
    Rgb reflectance(const std::string& name, float missing);
    /// Channels of at least 0. `use` is for spectra.
    Rgb positiveColor(const std::string& name, Rgb missing, ColorUse use = ColorUse::unbounded);
    /// With any channels.
    Rgb unboundedColor(const std::string& name, Rgb missing);
    /// Radiance or intensity: no channel negative. An emitter of which all are 0 is off.
    Rgb emission(const std::string& name, Rgb missing);

    /// Nested objects (or referenced ones) with this tag, in document order.
    std::vector<const Element*> objects(const std::string& tag);
    /// At most one such object, or nullptr.
    const Element* object(const std::string& tag);

    /// The <texture> that gives this parameter, nested or referenced, or nullptr. Throws InputError where the parameter
    /// is given as a value too. A texture that is one colour everywhere is no texture here but a colour or number.
    const Element* texture(const std::string& name);
    /// The <medium> of that name, nested or referenced, or nullptr.
    const Element* medium(const std::string& name) { return named("medium", name); }

    /// The <volume> of that name, likewise.
    const Element* volume(const std::string& name) { return named("volume", name); }

    /// The parameter's element or nullptr; marks it as used.
    const Element* find(const std::string& name);
    /// Known to Mitsuba and without effect here.
    void accept(const Names& names);
    /// Known to Mitsuba; an error here, that says `why`.
    void refuse(const std::string& name, const std::string& why);
    /// Everything else is accepted without a look at its value.
    void acceptAll();
    /// Throws InputError for the first parameter or object that nobody asked for.
    void finish() const;

private:
    std::string among(const Names& known, const std::string& name, const std::string& value,
                      const std::string& missing);
    double nearest(const std::string& name, double value, double lowest, double highest);
    Rgb withinRange(const std::string& name, Rgb color, float highest, const std::string& message);
    const Element* find(const std::string& name, const Names& tags);
    const Element* constantTexture(const std::string& name);
    std::optional<Rgb> color(const std::string& name, ColorUse use);
    const Element* named(const std::string& tag, const std::string& name);
    void checkObject(const Element& object) const;

    const Element& element_;
    LoadContext& context_;
    std::map<std::string, const Element*> parameters_;
    std::vector<const Element*> objects_; ///< nested objects and references, as written
    std::set<std::string> knownNames_, knownTags_;
    std::map<std::string, std::set<std::string>> knownNamed_; ///< by tag, of objects that go by name
};

} // namespace quasilux
