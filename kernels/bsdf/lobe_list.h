/* Every lobe the kernels know: one line here and one file kernels/bsdf/<name>.clh make a new one.
 * X(ID, name): LOBE_<ID> is the value of Lobe.type, <name>Eval/PdfSolidAngle/Sample/Albedo are the functions of the file.
 * The host defines HAS_LOBE_<ID> for the lobes that the scene uses; the others are not compiled. */
#ifndef QUASILUX_LOBE_LIST_H
#define QUASILUX_LOBE_LIST_H

enum LobeType {
    LOBE_LAMBERT = 0,
    LOBE_PHONG = 1,
    LOBE_GGX = 2,
    LOBE_BECKMANN = 3,
    LOBE_CONDUCTOR = 4,
    LOBE_DIELECTRIC = 5,
    LOBE_TYPES
};

#endif
