// What the readers of single objects share: the scene being made, the ids, the warnings.
#pragma once

#include "scene/embedded_parts.h"
#include "scene/scene.h"
#include "scene/xml/element.h"
#include "scene/xml/file_resolver.h"

#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

namespace quasilux {

struct MeshSource;

/// What instances make of a shapegroup.
struct GroupUse {
    size_t places = 0;
    bool isKept = false;                  ///< once for all instances; else they are flattened
    std::vector<ShapeDescription> shapes; ///< in its own space, where that was asked for
    glm::dvec3 center{0};                 ///< of its own space
    std::optional<unsigned> index;        ///< into Scene::groups
};

class LoadContext {
public:
    /// Collects the ids below `root` and their aliases. Throws InputError for an id given twice.
    LoadContext(const Element& root, const FileResolver& files, Scene& scene);

    /// The element that `element` stands for: itself, or what a <ref> names. Throws InputError for an unknown id.
    const Element& resolve(const Element& element) const;

    void warn(const SourceLocation& where, const std::string& message);
    /// Throws InputError with this message, or notes it and what is done instead where the unknown, or out of range, is forgiven.
    void refuseUnknown(const SourceLocation& where, const std::string& message, const std::string& instead);

    /// Throws InputError where `element`, which is to be read within the objects of `open`, contains itself, lies too
    /// deep, or where objects that refer to each other multiply without end.
    void enter(const Element& element, std::vector<const Element*>& open);

    /// Of the first shape that needs an area and has none in single precision. It is thrown when all has been read about
    /// the scene's own origin: about that of the file, shapes far from it may have lost theirs to rounding.
    std::optional<InputError> withoutArea;

    Unknown unknown = Unknown::refused;
    std::vector<std::string> forgiven; ///< "file:line:column: …", in the order of reading

    Scene& scene;
    const FileResolver& files;
    const EmbeddedParts* embedded = nullptr;           ///< null: the scene holds none
    std::unordered_map<const Element*, int> bsdfIndex; ///< of bsdfs that shapes use, into Scene::bsdfs
    /// Of textures in use, by use, into Scene::textures; -1: one colour.
    std::unordered_map<const Element*, std::map<TextureUse, int>> textureIndex;
    std::unordered_map<int, unsigned> scalarTextureIndex;     ///< of the grey copy of a coloured texture
    std::unordered_map<const Element*, unsigned> mediumIndex; ///< of media in use, into Scene::media
    std::unordered_map<const Element*, unsigned> volumeIndex; ///< of volumes in use, into Scene::volumes
    std::set<const Element*> shownVolumes;                    ///< by textures
    std::vector<const Element*> openPhases;                   ///< being read now, as openBsdfs
    std::set<const Element*> usedPhases;                      ///< that a medium has
    int defaultBsdf = -1, defaultEmitterBsdf = -1;            ///< of shapes without one; -1 until the first needs it
    std::vector<const Element*> openBsdfs;                    ///< being read now, outermost first: a cycle shows here
    std::vector<const Element*> openTextures;                 ///< likewise
    std::map<std::tuple<std::string, bool, TextureUse>, Image> images; ///< read already, by path and `raw`
    std::map<std::tuple<std::string, size_t, double, bool>, unsigned>
        luminaireTypes; ///< into Scene::luminaireTypes, by path, set of lamps, unit, and whether the shape shines
    std::set<const Element*> usedEmitters; ///< that a shape has
    unsigned emittersOff = 0;              ///< and left out
    std::set<const Element*> usedGroups;   ///< shapegroups that an instance places
    std::optional<glm::dmat4> placement;   ///< of the instance whose shapes are being read
    std::unordered_map<const Element*, GroupUse> groupUse;
    std::vector<const Element*> plainGroups;  ///< by PlainInstances::groupIds
    std::vector<const Element*> placedGroups; ///< all in groupUse, in the order of the file
    std::vector<GroupUse*> keptGroups;        ///< in the order of Scene::groups
    std::set<std::string> brightAttributes;   ///< of meshes, warned of
    /// Of the files that instances place more than once, by path and options.
    std::map<std::string, std::shared_ptr<const MeshSource>> instancedMeshes;

private:
    void collect(const Element& element);
    void collectAliases(const Element& root);
    void add(const std::string& id, const Element& named, const SourceLocation& where);
    const Element& find(const std::string& id, const SourceLocation& where) const;

    std::unordered_map<std::string, const Element*> ids_;
    unsigned nestedReads_ = 0;
};

/// The id of an object, or "<plugin>@line".
std::string idOf(const Element& element);

} // namespace quasilux
