// Files of shapes, read and built as a scene has it.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "scene/loader.h"

namespace quasilux::fuzz {

namespace {

/// A scene with a shape of a file, whose text is read once.
class ShapeScene {
public:
    ShapeScene(const std::string& plugin, const std::string& parameters = "")
        : file_(plugin + ".dat"),
          path_(
              write(plugin + ".xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><emitter type=\"point\"/>"
                                     "<shape type=\"" +
                                         plugin + "\"><string name=\"filename\" value=\"" + file_ + "\"/>" +
                                         parameters + "</shape></scene>")),
          document_(readSceneDocument(path_, {})) {}

    void read(std::string_view content) const {
        write(file_, content);
        expectInputErrors([&] { loadScene(document_, path_, {}); });
    }

private:
    std::string file_, path_;
    SceneDocument document_;
};

} // namespace

void readObjFile(std::string_view input) {
    static const ShapeScene scene("obj");
    scene.read(input);
}

void readPlyFile(std::string_view input) {
    static const ShapeScene scene("ply");
    scene.read(input);
}

// The first byte chooses the mesh of the file.
void readSerializedFile(std::string_view input) {
    static const ShapeScene first("serialized"), second("serialized", "<integer name=\"shape_index\" value=\"1\"/>");
    if (input.empty()) return;
    (input[0] == '1' ? second : first).read(input.substr(1));
}

// The first byte chooses the shape.
void readCurveFile(std::string_view input) {
    static const ShapeScene smooth("bsplinecurve"), straight("linearcurve");
    if (input.empty()) return;
    (input[0] == 'l' ? straight : smooth).read(input.substr(1));
}

} // namespace quasilux::fuzz
