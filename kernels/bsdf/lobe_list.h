/* Every lobe the kernels know, in the order of Lobe.type. A new lobe is one line here and one file in kernels/bsdf/lobes/,
 * which docs/bsdf.md describes. The host compiles only those that the scene uses (HAS_LOBE_<ID>). */
#ifndef QUASILUX_LOBE_LIST_H
#define QUASILUX_LOBE_LIST_H

/* X(ID, argument) for each lobe; `argument` is handed through. */
#define LOBE_LIST(X, argument)                                                                                         \
    X(LAMBERT, argument)                                                                                               \
    X(PHONG, argument)                                                                                                 \
    X(GGX, argument)                                                                                                   \
    X(BECKMANN, argument)                                                                                              \
    X(CONDUCTOR, argument)                                                                                             \
    X(DIELECTRIC, argument)                                                                                            \
    X(THINDIELECTRIC, argument)

#define LOBE_ENUMERATOR(ID, argument) LOBE_##ID,
enum LobeType { LOBE_LIST(LOBE_ENUMERATOR, ) LOBE_TYPES };

#endif
