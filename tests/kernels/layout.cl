/* Writes the size of every shared struct, and offset and size of every field, as the device's compiler lays them out.
 */
#include "pass_types.h"
#include "shared_types.h"

#define STRUCT(type) sizes[n++] = (uint)sizeof(type);
#define FIELD(type, field)                                                                                             \
    {                                                                                                                  \
        __global const type* object = (__global const type*)memory;                                                    \
        sizes[n++] = (uint)((__global const char*)&object->field - memory);                                            \
        sizes[n++] = (uint)sizeof(object->field);                                                                      \
    }

__kernel void layout(__global const char* memory, __global uint* sizes) {
    if (get_global_id(0) != 0) return;
    uint n = 0;
#include "layout_fields.h"
}
