/* Blocks of cells of a grid, whose largest values follow the grid's own, x fastest; shared by host and device. A row of
 * n voxels has cells -1 to n - 1, the outermost half beyond. */
#ifndef QUASILUX_VOLUME_BLOCKS_H
#define QUASILUX_VOLUME_BLOCKS_H

#define VOLUME_BLOCK_SHIFT 2
#define VOLUME_BLOCK (1 << VOLUME_BLOCK_SHIFT)
#define VOLUME_BLOCKS(n) (((int)(n) + VOLUME_BLOCK) >> VOLUME_BLOCK_SHIFT)

#endif
