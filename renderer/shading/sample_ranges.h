#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace celadon {

/// What the samples of each pixel have in common, so that a pass over the pixels need not ask one
/// by one.
/// @param triangles     [sample][pixel]: number + 1, 0 where nothing is seen
/// @param centerDepths  the same of TriangleRaster::centerDepths()
/// @param meshEnds      for each mesh one more than the number of its last triangle, ascending
/// @param ranges        [pixel]: least and greatest depth if all samples see one mesh, 0 and 0 if
///                      none sees anything, else -1 and -1; resized
void findSampleRanges(std::span<const std::uint32_t> triangles, std::span<const float> centerDepths,
                      std::size_t pixels, std::span<const std::uint32_t> meshEnds,
                      std::vector<glm::vec2>& ranges);

} // namespace celadon
