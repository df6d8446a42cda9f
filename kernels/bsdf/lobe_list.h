/* Every lobe the kernels know, in the order of Lobe.type. A new lobe is one line here and one file in
 * kernels/bsdf/lobes/, which docs/method/bsdf.md describes. The host compiles only those that the scene uses
 * (HAS_LOBE_<ID>). */
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
    X(THINDIELECTRIC, argument)                                                                                        \
    X(GGXDIELECTRIC, argument)                                                                                         \
    X(BECKMANNDIELECTRIC, argument)                                                                                    \
    X(COATEDLAMBERT, argument)                                                                                         \
    X(PASSAGE, argument)                                                                                               \
    X(ROUGHCOATEDLAMBERT, argument)                                                                                    \
    X(PRINCIPLEDDIFFUSE, argument)                                                                                     \
    X(SHEEN, argument)                                                                                                 \
    X(GGXSCHLICK, argument)                                                                                            \
    X(CLEARCOAT, argument)                                                                                             \
    X(THINGGX, argument)                                                                                               \
    X(DIFFUSETRANSMISSION, argument)                                                                                   \
    X(PANE, argument)

#define LOBE_ENUMERATOR(ID, argument) LOBE_##ID,
enum LobeType { LOBE_LIST(LOBE_ENUMERATOR, ) LOBE_TYPES };

/* Lobes as broad as Lambert's, f being bounded by 1 / pi times a constant. */
#define LOBE_IS_BROAD(type)                                                                                            \
    ((type) == LOBE_LAMBERT || (type) == LOBE_COATEDLAMBERT || (type) == LOBE_ROUGHCOATEDLAMBERT ||                    \
     (type) == LOBE_PRINCIPLEDDIFFUSE || (type) == LOBE_SHEEN || (type) == LOBE_DIFFUSETRANSMISSION)

/* A lobe that lets light pass straight on is no event of a path: no class begins, and shadow rays pass too. */
#define LOBE_PASSES(type) ((type) == LOBE_PASSAGE || (type) == LOBE_PANE)
#if defined(HAS_LOBE_PASSAGE) || defined(HAS_LOBE_PANE)
#define HAS_PASSING_LOBE
#endif

/* Lobes of microfacets whose roughness may differ along two axes, alphaU and alphaV. */
#define LOBE_HAS_TWO_ALPHAS(type)                                                                                      \
    ((type) == LOBE_GGX || (type) == LOBE_BECKMANN || (type) == LOBE_GGXDIELECTRIC ||                                  \
     (type) == LOBE_BECKMANNDIELECTRIC || (type) == LOBE_GGXSCHLICK || (type) == LOBE_THINGGX)

/* A conductor, or what a thin sheet reflects, whose index of refraction goes by textures. */
#ifdef HAS_INDEX_TEXTURES
#define LOBE_INDEX_VARIES(lobe) (((lobe)->etaTexture | (lobe)->kTexture) != 0)
#else
#define LOBE_INDEX_VARIES(lobe) 0
#endif

/* Lobes that transmit without being delta: light from both sides of a surface counts (LOBE_TRANSMITS). */
#if defined(HAS_LOBE_GGXDIELECTRIC) || defined(HAS_LOBE_BECKMANNDIELECTRIC) || defined(HAS_LOBE_THINGGX) ||            \
    defined(HAS_LOBE_DIFFUSETRANSMISSION)
#define HAS_TRANSMITTING_LOBE
#endif
#define LOBE_TRANSMITS(type)                                                                                           \
    ((type) == LOBE_GGXDIELECTRIC || (type) == LOBE_BECKMANNDIELECTRIC || (type) == LOBE_THINGGX ||                    \
     (type) == LOBE_DIFFUSETRANSMISSION)

#endif
