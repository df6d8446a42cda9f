// Every kind of bad input is refused at its place, with what is wrong and what was expected.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;
using test::sceneWith;

struct BadBody {
    const char* name;
    const char* body;                  ///< starts at line 4, column 1 of scene.xml
    std::vector<const char*> expected; ///< parts of the message
};
void PrintTo(const BadBody& bad, std::ostream* out) { *out << bad.body; }

class BadScene : public testing::TestWithParam<BadBody> {};

TEST_P(BadScene, IsRefusedAtItsPlace) {
    SceneFiles files;
    const std::string message = errorOf(files.write("scene.xml", sceneWith(GetParam().body)));
    for (const char* part : GetParam().expected) EXPECT_THAT(message, testing::HasSubstr(part));
}

const BadBody badBodies[] = {
    // names
    {"Element", "<shap type=\"cube\"/>", {"scene.xml:4:1: unknown element <shap>", "Did you mean 'shape'?"}},
    {"CamelCaseElement",
     "<shape type=\"cube\"><transform name=\"to_world\">\n <lookAt origin=\"0,0,1\" "
     "target=\"0,0,0\"/></transform></shape>",
     {"scene.xml:5:2: unknown element <lookAt>", "Did you mean 'lookat'?"}},
    {"Attribute",
     "<shape typ=\"cube\"/>",
     {"scene.xml:4:1: <shape> has no attribute 'typ'", "Did you mean 'type'?", "Known: type, id, name"}},
    {"MissingAttribute", "<shape/>", {"scene.xml:4:1: <shape> needs the attribute 'type'"}},
    {"AttributeTwice",
     "<shape type=\"cube\" type=\"cube\"/>",
     {"scene.xml:4:1: <shape> has the attribute 'type' twice"}},
    {"ShapePlugin",
     "<shape type=\"cub\"/>",
     {"scene.xml:4:1: unknown shape plugin 'cub'", "Did you mean 'cube'?", "Known: rectangle, cube, sphere, obj, ply"}},
    {"BsdfPlugin",
     "<bsdf type=\"difuse\"/>",
     {"scene.xml:4:1: unknown bsdf plugin 'difuse'", "Did you mean 'diffuse'?"}},
    {"EmitterPlugin",
     "<emitter type=\"points\"/>",
     {"scene.xml:4:1: unknown emitter plugin 'points'", "Did you mean 'point'?"}},
    {"IntegratorPlugin",
     "<integrator type=\"pathh\"/>",
     {"scene.xml:4:1: unknown integrator plugin 'pathh'", "Did you mean 'path'?"}},
    {"SensorPlugin",
     "<sensor type=\"thinlens\"/>",
     {"scene.xml:4:1: unknown sensor plugin 'thinlens'", "Known: perspective"}},
    {"SamplerPlugin",
     "<sensor type=\"perspective\">\n<sampler type=\"halton\"/></sensor>",
     {"scene.xml:5:1: unknown sampler plugin 'halton'"}},
    {"FilmPlugin",
     "<sensor type=\"perspective\">\n<film type=\"ldrfilm\"/></sensor>",
     {"scene.xml:5:1: unknown film plugin 'ldrfilm'", "'hdrfilm'"}},
    {"FilterPlugin",
     "<sensor type=\"perspective\"><film type=\"hdrfilm\">\n<rfilter type=\"gausian\"/></film></sensor>",
     {"scene.xml:5:1: unknown rfilter plugin 'gausian'", "Did you mean 'gaussian'?"}},
    {"Parameter",
     "<bsdf type=\"diffuse\">\n<rgb name=\"reflectence\" value=\"0.5\"/></bsdf>",
     {"scene.xml:5:1: unknown parameter 'reflectence' of bsdf 'diffuse'", "Did you mean 'reflectance'?",
      "Known: reflectance."}},
    {"CamelCaseParameter",
     "<shape type=\"cube\">\n<transform name=\"toWorld\"/></shape>",
     {"scene.xml:5:1: unknown parameter 'toWorld' of shape 'cube'", "Did you mean 'to_world'?"}},
    {"ParameterTwice",
     "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.5\"/>\n<rgb name=\"reflectance\" "
     "value=\"0.5\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance' is given twice", "scene.xml:4:22"}},
    {"NestedObject",
     "<bsdf type=\"diffuse\">\n<bsdf type=\"diffuse\"/></bsdf>",
     {"scene.xml:5:1: bsdf 'diffuse' takes no <bsdf>"}},
    {"WeightTexture",
     "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/>\n<texture type=\"bitmap\" "
     "name=\"weight\"/></bsdf>",
     {"scene.xml:5:1: bsdf 'blendbsdf' takes no texture as 'weight'"}},
    {"Medium",
     "<shape type=\"cube\">\n<medium type=\"heterogeneous\" name=\"interior\"/></shape>",
     {"scene.xml:5:1: unknown medium plugin 'heterogeneous'"}},
    {"Misplaced", "<float name=\"x\" value=\"1\"/>", {"scene.xml:4:1: <float> may not stand in <scene>"}},
    {"OperationOutsideOfATransform",
     "<shape type=\"cube\">\n<scale value=\"2\"/></shape>",
     {"scene.xml:5:1: <scale> may not stand in <shape>"}},
    {"FilmInScene", "<film type=\"hdrfilm\"/>", {"scene.xml:4:1: <film> may not stand directly in <scene>"}},
    {"Text", "<shape type=\"cube\">hello</shape>", {"scene.xml:4:20: text 'hello' in <shape>"}},
    // types and numbers
    {"WrongType",
     "<sensor type=\"perspective\">\n<string name=\"fov\" value=\"40\"/></sensor>",
     {"scene.xml:5:1: parameter 'fov' of sensor 'perspective' is a <string>; expected <float>"}},
    {"WrongColorType",
     "<bsdf type=\"diffuse\">\n<string name=\"reflectance\" value=\"red\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance' is a <string>; expected <rgb>"}},
    {"NotANumber",
     "<shape type=\"sphere\">\n<float name=\"radius\" value=\"1.5m\"/></shape>",
     {"scene.xml:5:1: parameter 'radius': '1.5m' is not a number"}},
    {"Nan",
     "<shape type=\"sphere\">\n<float name=\"radius\" value=\"nan\"/></shape>",
     {"scene.xml:5:1: parameter 'radius': 'nan' is not finite"}},
    {"Infinity",
     "<shape type=\"sphere\">\n<float name=\"radius\" value=\"inf\"/></shape>",
     {"scene.xml:5:1: parameter 'radius': 'inf' is not finite"}},
    {"Overflow",
     "<shape type=\"sphere\">\n<float name=\"radius\" value=\"1e999\"/></shape>",
     {"scene.xml:5:1: parameter 'radius': '1e999' is out of the range"}},
    {"Integer",
     "<integrator type=\"path\">\n<integer name=\"max_depth\" value=\"5.5\"/></integrator>",
     {"scene.xml:5:1: parameter 'max_depth': '5.5' is not an integer"}},
    {"Boolean",
     "<shape type=\"cube\">\n<boolean name=\"flip_normals\" value=\"yes\"/></shape>",
     {"scene.xml:5:1: parameter 'flip_normals': 'yes' is not a boolean"}},
    {"TwoNumbersInRgb",
     "<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"1,0\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance': <rgb> has 2 numbers"}},
    {"HexColor",
     "<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"#ff00\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance': '#ff00' is not a colour"}},
    {"Spectrum",
     "<bsdf type=\"diffuse\">\n<spectrum name=\"reflectance\" value=\"400:0.1, 700:0.9\"/></bsdf>",
     {"scene.xml:5:1:", "spectra by wavelength are not supported"}},
    {"PointWithoutZ",
     "<emitter type=\"point\">\n<point name=\"position\" x=\"1\" y=\"2\"/></emitter>",
     {"scene.xml:5:1: parameter 'position': give x, y and z"}},
    // transforms
    {"NanInTransform",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<translate x=\"nan\"/></transform></shape>",
     {"scene.xml:5:1: <translate> x: 'nan' is not finite"}},
    {"SingularScale",
     "<shape type=\"cube\">\n<transform name=\"to_world\"><scale x=\"0\"/></transform></shape>",
     {"scene.xml:5:1: transform is singular"}},
    {"SingularMatrix",
     "<shape type=\"cube\">\n<transform name=\"to_world\"><matrix value=\"1 2 3 4 5 6 7 8 9\"/></transform></shape>",
     {"scene.xml:5:1: transform is singular"}},
    {"OverflowingTransform",
     "<shape type=\"cube\">\n<transform name=\"to_world\"><scale value=\"1e200\"/><scale "
     "value=\"1e200\"/></transform></shape>",
     {"scene.xml:5:1: transform: the product"}},
    {"BeyondSinglePrecision",
     "<shape type=\"cube\"><transform name=\"to_world\"><translate x=\"1e39\"/></transform></shape>",
     {"scene.xml:4:1: the point", "single precision"}},
    {"Matrix",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<matrix value=\"1 2 3\"/></transform></shape>",
     {"scene.xml:5:1: <matrix>: 3 numbers; expected 16 or 9"}},
    {"Projective",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 "
     "1\"/></transform></shape>",
     {"scene.xml:5:1: <matrix>: the last row"}},
    {"RotationAxis",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<rotate x=\"0\" angle=\"3\"/></transform></shape>",
     {"scene.xml:5:1: <rotate>: the axis is zero"}},
    {"RotationAngle",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<rotate x=\"1\"/></transform></shape>",
     {"scene.xml:5:1: <rotate> needs the attribute 'angle'"}},
    {"LookAt",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<lookat origin=\"1,1,1\" target=\"1,1,1\" "
     "up=\"0,1,0\"/></transform></shape>",
     {"scene.xml:5:1: <lookat>: origin and target are the same"}},
    {"LookAtUp",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<lookat origin=\"0,0,0\" target=\"0,2,0\" "
     "up=\"0,1,0\"/></transform></shape>",
     {"scene.xml:5:1: <lookat>: up is parallel"}},
    {"BothForms",
     "<shape type=\"cube\"><transform name=\"to_world\">\n<scale x=\"1\" value=\"2\"/></transform></shape>",
     {"scene.xml:5:1: <scale> has both value and x, y, z"}},
    {"SphereUnderScale",
     "<shape type=\"sphere\">\n<transform name=\"to_world\"><scale x=\"2\"/></transform></shape>",
     {"scene.xml:5:1: to_world of a sphere scales directions differently"}},
    {"ScaledSensor",
     "<sensor type=\"perspective\">\n<transform name=\"to_world\"><scale value=\"2\"/></transform></sensor>",
     {"scene.xml:5:1: to_world of the sensor scales"}},
    {"SecondSky",
     "<emitter type=\"constant\"/>\n<emitter type=\"constant\"/>",
     {"scene.xml:5:1: a second emitter 'constant', after line 4"}},
    {"NegativeSky",
     "<emitter type=\"constant\">\n<rgb name=\"radiance\" value=\"1,-1,1\"/></emitter>",
     {"scene.xml:5:1"}},
    {"UnknownPane",
     "<shape type=\"cube\"><bsdf type=\"thindielectric\">\n<string name=\"int_ior\" value=\"bk8\"/></bsdf></shape>",
     {"scene.xml:5:1: parameter 'int_ior': unknown material 'bk8'", "Did you mean 'bk7'?"}},
    // ids and references
    {"DuplicateId",
     "<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>",
     {"scene.xml:5:1: the id 'a' is already in use at", "scene.xml:4:1"}},
    {"UnresolvedReference",
     "<bsdf type=\"diffuse\" id=\"paint\"/><shape type=\"cube\">\n<ref id=\"pain\"/></shape>",
     {"scene.xml:5:1: no object has the id 'pain'", "Did you mean 'paint'?"}},
    {"BsdfCycle",
     "<bsdf type=\"twosided\" id=\"a\">\n<ref id=\"b\"/></bsdf><bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>",
     {"scene.xml:4:1: bsdf 'a' contains itself"}},
    {"UndefinedParameter",
     "<default name=\"size\" value=\"1\"/>\n<shape type=\"$sise\"/>",
     {"scene.xml:5:1: parameter '$sise' has no value", "Did you mean 'size'?"}},
    // bsdfs
    {"Reflectance",
     "<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"0.5,1.1,0\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance' of bsdf 'diffuse' is (0.5, 1.1, 0)", "[0, 1]"}},
    {"NegativeReflectance",
     "<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"-0.1\"/></bsdf>",
     {"scene.xml:5:1: parameter 'reflectance'", "no channel may be negative"}},
    {"PhongEnergy",
     "<bsdf type=\"phong\"><rgb name=\"diffuse_reflectance\" value=\"0.5,0.9,0\"/></bsdf>",
     {"scene.xml:4:1: phong: diffuse_reflectance + specular_reflectance is (0.7, 1.1, 0.2)"}},
    {"PhongExponent",
     "<bsdf type=\"phong\">\n<float name=\"exponent\" value=\"-1\"/></bsdf>",
     {"scene.xml:5:1: parameter 'exponent' of bsdf 'phong' is -1; it must be at least 0"}},
    {"Alpha",
     "<bsdf type=\"roughconductor\">\n<float name=\"alpha\" value=\"0\"/></bsdf>",
     {"scene.xml:5:1: parameter 'alpha' is 0", "conductor"}},
    {"AlphaAndAlphaU",
     "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.1\"/>\n<float name=\"alpha_u\" "
     "value=\"0.1\"/></bsdf>",
     {"scene.xml:5:1: roughconductor: give either alpha, or both"}},
    {"Distribution",
     "<bsdf type=\"roughconductor\">\n<string name=\"distribution\" value=\"phong\"/></bsdf>",
     {"scene.xml:5:1:", "unknown value 'phong'", "Known: beckmann, ggx"}},
    {"Metal",
     "<bsdf type=\"conductor\">\n<string name=\"material\" value=\"Fe\"/></bsdf>",
     {"scene.xml:5:1: unknown material 'Fe'", "none, Cu, Au, Ag, Al, Cr", "give eta and k"}},
    {"MetalAndEta",
     "<bsdf type=\"conductor\"><float name=\"eta\" value=\"1\"/>\n<string name=\"material\" value=\"Cu\"/></bsdf>",
     {"scene.xml:5:1: bsdf 'conductor' has both material and eta or k"}},
    {"Glass",
     "<bsdf type=\"dielectric\">\n<string name=\"int_ior\" value=\"watr\"/></bsdf>",
     {"scene.xml:5:1: parameter 'int_ior': unknown material 'watr'", "Did you mean 'water'?"}},
    {"RefractiveIndex",
     "<bsdf type=\"dielectric\">\n<float name=\"int_ior\" value=\"0\"/></bsdf>",
     {"scene.xml:5:1: parameter 'int_ior' of bsdf 'dielectric' is 0; it must be greater than 0"}},
    {"RoughGlassTooSmooth",
     "<bsdf type=\"roughdielectric\">\n<float name=\"alpha\" value=\"0\"/></bsdf>",
     {"scene.xml:5:1: parameter 'alpha' is 0", "<bsdf type=\"dielectric\">"}},
    {"RoughGlassOfAir",
     "<bsdf type=\"roughdielectric\"><float name=\"ext_ior\" value=\"1.2\"/>\n<float name=\"int_ior\" "
     "value=\"1.2\"/></bsdf>",
     {"scene.xml:5:1: roughdielectric: int_ior and ext_ior are equal"}},
    {"RoughGlassAlphas",
     "<bsdf type=\"roughdielectric\">\n<float name=\"alpha_u\" value=\"0.1\"/></bsdf>",
     {"scene.xml:5:1: roughdielectric: give either alpha, or both"}},
    {"TwoSidedRoughGlass",
     "<bsdf type=\"twosided\">\n<bsdf type=\"roughdielectric\"/></bsdf>",
     {"scene.xml:5:1: twosided: the nested bsdf 'roughdielectric' lets light through"}},
    {"BlendWeight",
     "<bsdf type=\"blendbsdf\">\n<float name=\"weight\" value=\"1.5\"/></bsdf>",
     {"scene.xml:5:1: parameter 'weight' is 1.5"}},
    {"BlendOfOne",
     "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/></bsdf>",
     {"scene.xml:4:1: blendbsdf has 1 nested bsdfs; it needs two"}},
    {"BlendOfNull",
     "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/>\n<bsdf type=\"null\"/></bsdf>",
     {"scene.xml:5:1: blendbsdf with a null bsdf"}},
    {"TwoSidedGlass",
     "<bsdf type=\"twosided\">\n<bsdf type=\"dielectric\"/></bsdf>",
     {"scene.xml:5:1: twosided: the nested bsdf 'dielectric' lets light through"}},
    {"TwoSidedNull",
     "<bsdf type=\"twosided\">\n<bsdf type=\"null\"/></bsdf>",
     {"scene.xml:5:1: twosided: the nested bsdf 'null' lets light through"}},
    // emitters
    {"BlackRadiance",
     "<shape type=\"cube\"><emitter type=\"area\">\n<rgb name=\"radiance\" value=\"0\"/></emitter></shape>",
     {"scene.xml:5:1: parameter 'radiance' of emitter 'area' is (0, 0, 0)", "needs a positive channel"}},
    {"NegativeRadiance",
     "<shape type=\"cube\"><emitter type=\"area\">\n<rgb name=\"radiance\" value=\"1,1,-1\"/></emitter></shape>",
     {"scene.xml:5:1: parameter 'radiance' of emitter 'area' is (1, 1, -1)"}},
    {"AreaInScene", "<emitter type=\"area\"/>", {"scene.xml:4:1: emitter 'area' stands alone"}},
    {"PointInShape",
     "<shape type=\"cube\">\n<emitter type=\"point\"/></shape>",
     {"scene.xml:5:1: emitter 'point' is nested in a shape"}},
    {"TwoEmitters",
     "<shape type=\"cube\"><emitter type=\"area\"/>\n<emitter type=\"area\"/></shape>",
     {"scene.xml:5:1: shape 'cube' has 2 objects <emitter>; expected one"}},
    {"ZeroAreaByUnderflow",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"1e-30\"/></transform><emitter "
     "type=\"area\"/></shape>",
     {"scene.xml:4:1: shape 'rectangle@4' emits but has no area"}},
    // sensor, film, integrator
    {"FieldOfView",
     "<sensor type=\"perspective\">\n<float name=\"fov\" value=\"180\"/></sensor>",
     {"scene.xml:5:1: parameter 'fov' is 180; expected degrees between 0 and 180"}},
    {"FovAxis",
     "<sensor type=\"perspective\">\n<string name=\"fov_axis\" value=\"z\"/></sensor>",
     {"scene.xml:5:1:", "Known: x, y, diagonal, smaller, larger"}},
    {"FocalLength",
     "<sensor type=\"perspective\">\n<string name=\"focal_length\" value=\"wide\"/></sensor>",
     {"scene.xml:5:1: parameter 'focal_length'", "'wide' is not a number"}},
    {"PrincipalPoint",
     "<sensor type=\"perspective\">\n<float name=\"principal_point_offset_x\" value=\"0.1\"/></sensor>",
     {"scene.xml:5:1: parameter 'principal_point_offset_x'", "not supported"}},
    {"Clip",
     "<sensor type=\"perspective\"><float name=\"near_clip\" value=\"5\"/>\n<float name=\"far_clip\" "
     "value=\"5\"/></sensor>",
     {"scene.xml:5:1: parameter 'far_clip' of sensor 'perspective' is 5; it must be greater than 5"}},
    {"Crop",
     "<sensor type=\"perspective\"><film type=\"hdrfilm\">\n<integer name=\"crop_width\" value=\"5\"/></film></sensor>",
     {"scene.xml:5:1: parameter 'crop_width' of film 'hdrfilm' is not supported"}},
    {"FilmSize",
     "<sensor type=\"perspective\"><film type=\"hdrfilm\">\n<integer name=\"width\" value=\"0\"/></film></sensor>",
     {"scene.xml:5:1: parameter 'width' is 0; expected 1 to"}},
    {"FilterRadius",
     "<sensor type=\"perspective\"><film type=\"hdrfilm\">\n<rfilter type=\"tent\"><float name=\"radius\" "
     "value=\"0\"/></rfilter></film></sensor>",
     {"scene.xml:5:22: parameter 'radius' of rfilter 'tent' is 0"}},
    {"DepthZero",
     "<integrator type=\"path\">\n<integer name=\"max_depth\" value=\"0\"/></integrator>",
     {"scene.xml:5:1: parameter 'max_depth' is 0; expected -1"}},
    {"DepthBelowMinusOne",
     "<integrator type=\"path\">\n<integer name=\"max_depth\" value=\"-2\"/></integrator>",
     {"scene.xml:5:1: parameter 'max_depth' is -2"}},
    {"TwoIntegrators",
     "<integrator type=\"path\"/>\n<integrator type=\"path\"/>",
     {"scene.xml:5:1: a second <integrator>"}},
    // files
    {"MissingMesh",
     "<shape type=\"obj\">\n<string name=\"filename\" value=\"none.obj\"/></shape>",
     {"scene.xml:5:1: cannot read the mesh file", "none.obj", "there is no such file"}},
    {"NoFileName", "<shape type=\"ply\"/>", {"scene.xml:4:1: shape 'ply' needs <string name=\"filename\""}},
    {"MissingInclude", "<include filename=\"none.xml\"/>", {"scene.xml:4:1: cannot read the scene file", "none.xml"}},
    {"IncludeLoop", "<include filename=\"scene.xml\"/>", {"scene.xml:4:1: include loop"}},
    {"Malformed", "<shape type=\"cube\">", {"malformed XML", "scene.xml:5:"}},
    {"NotClosed", "<shape type=\"cube", {"malformed XML"}},
    // quasilux settings
    {"SettingKey",
     "<?quasilux bbd=\"1\"?>",
     {"scene.xml:4:1: unknown key 'bbd' of <?quasilux?> in a scene", "Did you mean 'bdd'?"}},
    {"SettingNumber", "<?quasilux bdd=\"-1\"?>", {"scene.xml:4:1: bdd: '-1' is not an integer from 0"}},
    {"SettingVariant",
     "<?quasilux variant=\"mian\"?>",
     {"scene.xml:4:1: variant: unknown value 'mian'", "Did you mean 'main'?"}},
    {"SettingDirect",
     "<?quasilux direct=\"none\"?>",
     {"scene.xml:4:1: direct: unknown value 'none'", "Known: emitters, photons"}},
    {"SettingPhotons", "<?quasilux photons=\"0\"?>", {"scene.xml:4:1: photons: '0' is not an integer from 1"}},
    {"SettingSeed", "<?quasilux seed=\"18446744073709551616\"?>", {"scene.xml:4:1: seed:"}},
    {"SettingTwice",
     "<?quasilux bdd=\"1\"?>\n<?quasilux bdd=\"1\"?>",
     {"scene.xml:5:1: <?quasilux?> sets 'bdd' a second time"}},
    {"SettingYes",
     "<?quasilux quasi-specular=\"yes\"?>",
     {"scene.xml:4:1: quasi-specular=\"yes\" of a scene: expected auto, none, all"}},
    {"SettingSyntax", "<?quasilux bdd=1?>", {"scene.xml:4:1: <?quasilux bdd=1?>: expected a list of key=\"value\""}},
    {"SettingInAShape",
     "<shape type=\"cube\">\n<?quasilux quasi-specular=\"yes\"?></shape>",
     {"scene.xml:5:1: <?quasilux?> has no meaning in <shape>"}},
    {"LobeName",
     "<bsdf type=\"phong\">\n<?quasilux quasi-specular=\"specullar\"?></bsdf>",
     {"scene.xml:5:1: quasi-specular: this bsdf has no lobe 'specullar'", "Did you mean 'specular'?",
      "Known: diffuse, specular"}},
    {"LevelInABsdf",
     "<bsdf type=\"phong\">\n<?quasilux quasi-specular=\"level:0.1\"?></bsdf>",
     {"scene.xml:5:1: quasi-specular=\"level:0.1\": a level splits phase functions"}},
    {"BsdfKey",
     "<bsdf type=\"phong\">\n<?quasilux quasi-speclar=\"yes\"?></bsdf>",
     {"scene.xml:5:1: unknown key 'quasi-speclar'", "Did you mean 'quasi-specular'?"}},
};

INSTANTIATE_TEST_SUITE_P(Bodies, BadScene, testing::ValuesIn(badBodies),
                         [](const auto& row) { return std::string(row.param.name); });

struct BadFile {
    const char* name;
    const char* content;
    const char* expected;
};
void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.content; }

class BadSceneFile : public testing::TestWithParam<BadFile> {};

TEST_P(BadSceneFile, IsRefused) {
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml", GetParam().content)), testing::HasSubstr(GetParam().expected));
}

const BadFile badFiles[] = {
    {"Empty", "", "malformed XML"},
    {"NoSensor", "<scene version=\"3.0.0\"><emitter type=\"point\"/></scene>", "scene.xml: the scene has no <sensor>"},
    {"NoEmitter", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/></scene>",
     "scene.xml: the scene has no emitter"},
    {"NoVersion", "<scene/>", "scene.xml:1:1: <scene> needs the attribute 'version'"},
    {"BadVersion", "<scene version=\"three\"/>", "scene.xml:1:1: version 'three' is not a version"},
    {"OtherRoot", "<bsdf type=\"diffuse\"/>", "scene.xml:1:1: the outermost element is <bsdf>"},
    {"TwoRoots", "<scene version=\"3.0.0\"/>\n<scene version=\"3.0.0\"/>", "scene.xml:2:1: a second outermost element"},
    {"InstructionOutside", "<?quasilux bdd=\"1\"?><scene version=\"3.0.0\"/>",
     "scene.xml:1:1: <?quasilux?> outside of the scene"},
};
INSTANTIATE_TEST_SUITE_P(Files, BadSceneFile, testing::ValuesIn(badFiles),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(MissingScene, IsNamed) {
    EXPECT_THAT(errorOf("/nonexistent/scene.xml"),
                testing::HasSubstr("cannot read the scene file '/nonexistent/scene.xml'"));
}

TEST(FolderAsScene, IsRefused) { EXPECT_THAT(errorOf("/"), testing::HasSubstr("cannot read the scene file")); }

TEST(UnusedOption, IsRefusedWithTheNearestName) {
    SceneFiles files;
    const std::string path = files.write("scene.xml", sceneWith("<default name=\"size\" value=\"1\"/>"));
    EXPECT_THAT(errorOf(path, {{"siez", "2"}}),
                testing::HasSubstr("parameter 'siez' is not used by the scene. Did you mean 'size'?"));
}

TEST(ErrorInAnIncludedFile, NamesThatFile) {
    SceneFiles files;
    files.write("part.xml", "<scene version=\"3.0.0\">\n  <shape type=\"cone\"/></scene>");
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith("<include filename=\"part.xml\"/>"))),
                testing::HasSubstr("part.xml:2:3: unknown shape plugin 'cone'"));
}

TEST(DeepNesting, IsRefusedInsteadOfACrash) {
    std::string body;
    for (int i = 0; i < 100000; ++i) body += "<bsdf type=\"twosided\">";
    for (int i = 0; i < 100000; ++i) body += "</bsdf>";
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith(body))),
                testing::HasSubstr("elements nested deeper than 64"));
}

TEST(DoublingDefinitions, AreRefusedInsteadOfFillingTheMemory) {
    std::string values = "<default name=\"a0\" value=\"xx\"/>", blends = "<bsdf type=\"diffuse\" id=\"b0\"/>";
    for (int i = 1; i < 60; ++i) {
        const std::string before = std::to_string(i - 1), now = std::to_string(i),
                          ref = "<ref id=\"b" + before + "\"/>";
        values += "<default name=\"a" + now + "\" value=\"$a" + before + "$a" + before + "\"/>";
        blends += "<bsdf type=\"blendbsdf\" id=\"b" + now + "\">" + ref + ref + "</bsdf>";
    }
    SceneFiles files;
    EXPECT_THAT(errorOf(files.write("values.xml", sceneWith(values))),
                testing::HasSubstr("a value grows to more than"));
    EXPECT_THAT(errorOf(files.write("blends.xml", sceneWith(blends))), testing::HasSubstr("more than 32 lobes"));
}

} // namespace
} // namespace quasilux
