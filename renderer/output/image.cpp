#include "renderer/output/image.h"

#include <algorithm>

namespace celadon {

int FloatImage::channelIndex(const std::string& name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

float& FloatImage::at(int x, int y, int channel) {
    return pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)) *
                      channels.size() +
                  static_cast<std::size_t>(channel)];
}

float FloatImage::at(int x, int y, int channel) const {
    return const_cast<FloatImage&>(*this).at(x, y, channel);
}

} // namespace celadon
