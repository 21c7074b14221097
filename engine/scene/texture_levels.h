#pragma once

#include "scene/texture.h"

namespace peregrine::scene {

// Says where the levels of a texture lie, whose size is set, and makes room for their texels.
void lay_out_levels(Texture& texture);

// Fills the levels after the first. A texel of a level is the mean of what it covers of the level
// before, in linear light, also where sizes are odd and it covers parts of texels. Colours count as
// much as their alpha says: what is cut out of a mask does not stain its border. The mean of
// normals is shorter than they are; it stays so: where levels and texels are blended, rough places
// then count less, as they do in the mean of the finest level, and shading makes it unit again.
void fill_levels(Texture& texture);

} // namespace peregrine::scene
