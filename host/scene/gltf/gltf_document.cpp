#include "scene/gltf/gltf_document.h"

#include "scene/gltf/cameras.h"
#include "scene/gltf/elements.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/model_file.h"
#include "scene/gltf/scene_extras.h"
#include "scene/gltf/shapes.h"
#include "scene/xml/tags.h"
#include "util/file_ending.h"

namespace quasilux {

namespace {

class GltfTranslator {
public:
    GltfTranslator(const tinygltf::Model& model, const std::string& path, const FileResolver& files,
                   EmbeddedParts& parts)
        : context_{model, path, files, parts} {}

    Element translate() {
        root_.tag = "scene";
        root_.attributes = {{"version", "3.0.0"}};
        root_.where = {context_.path};
        // Candela, lux and nit: section "Units" of KHR_lights_punctual, and KHR_materials_emissive_strength.
        root_.instructions.push_back({{{"units", "photometric"}}, root_.where});
        readExtras();
        GltfShapes shapes(context_, root_);
        bool hasLight = false, hasCamera = false;
        for (const PlacedNode& node : placeNodes(context_)) {
            shapes.add(node);
            hasLight |= addLight(context_, node, root_);
            hasCamera |= addCamera(context_, node, root_);
        }
        if (!hasCamera && !hasGrid_) addView(shapes);
        if (!hasLight && !hasSky_ && !shapes.emits()) addSurroundings();
        listWithoutEffect();
        return std::move(root_);
    }
    std::vector<std::string>& warnings() { return warnings_; }

private:
    void readExtras() {
        const tinygltf::Scene* scene = shownScene(context_);
        if (!scene) return;
        for (Instruction& instruction : instructionsOf(scene->extras, context_.at("scenes.extras"))) {
            hasGrid_ |= instruction.kind == "illuminance-grid";
            root_.instructions.push_back(std::move(instruction));
        }
        auto sky = skyOf(scene->extras, context_.newId("sky", ""), context_.at("scenes.extras"));
        if (!sky) return;
        hasSky_ = true;
        root_.children.push_back(std::move(*sky));
    }

    void addView(const GltfShapes& shapes) {
        if (shapes.isEmpty())
            throw InputError({context_.path}, "the file's scene has neither a mesh with triangles nor a camera; there "
                                              "is nothing to see.");
        warn("no camera; the view is from in front, above and to the right, of all there is.");
        root_.children.push_back(viewOf(shapes.lower(), shapes.upper(), root_.where));
    }

    void addSurroundings() {
        warn("no light; white surroundings of 1 cd/m² light the scene.");
        Element surroundings = newObject("emitter", "constant", context_.newId("surroundings", ""), root_.where);
        addColor(surroundings, "radiance", glm::dvec3(1));
        root_.children.push_back(std::move(surroundings));
    }

    /// Once for all that is there and changes nothing.
    void listWithoutEffect() {
        for (const std::string& name : context_.model.extensionsUsed)
            if (!isKnownGltfExtension(name)) context_.withoutEffect.insert(name);
        if (!context_.model.animations.empty()) context_.withoutEffect.insert("animations");
        if (!context_.withoutEffect.empty())
            warn(fmt::format("not supported and without effect: {}.", fmt::join(context_.withoutEffect, ", ")));
    }

    void warn(const std::string& message) { warnings_.push_back(asMessage(context_.path + ": " + message)); }

    GltfContext context_;
    Element root_;
    std::vector<std::string> warnings_;
    bool hasGrid_ = false, hasSky_ = false;
};

} // namespace

bool isGltf(const std::string& path) {
    const std::string ending = fileEnding(path);
    return ending == ".gltf" || ending == ".glb";
}

SceneDocument readGltfDocument(const std::string& path, const SceneParameters& parameters, Unknown unknown,
                               std::shared_ptr<LoadGuard> guard) {
    if (!parameters.empty())
        throw InputError(fmt::format("parameter '{}' is not used by the scene: a glTF file has no parameters. Leave "
                                     "it out.",
                                     parameters.front().first));
    const FileResolver files(path, std::move(guard));
    files.guard().admit(path, {path});
    std::vector<std::string> forgiven;
    const tinygltf::Model model = readGltfModel(path, files, unknown, forgiven);
    const auto parts = std::make_shared<EmbeddedParts>();
    GltfTranslator translator(model, path, files, *parts);
    SceneDocument document{translator.translate(), files, std::move(forgiven), std::move(translator.warnings()), parts};
    checkTree(document.root);
    return document;
}

} // namespace quasilux
