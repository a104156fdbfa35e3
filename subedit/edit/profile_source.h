#pragma once

#include "subedit/edit/profile_editor.h"
#include "subedit/paint/surface.h"

/// A map's profiles as they were before an edit: what operators that look at other texels than
/// their own read, whatever has been written since.
namespace celadon::subedit {

class ProfileSource {
public:
    virtual ~ProfileSource() = default;
    /// knots x 3 values of ln P
    [[nodiscard]] virtual const float* profile(Surface::Texel texel) const = 0;
};

/// A map that does not change meanwhile.
class MapSource : public ProfileSource {
public:
    explicit MapSource(const MaterialMap& map) : mMap(map), mValues(layoutOf(map).values()) {}
    [[nodiscard]] const float* profile(Surface::Texel texel) const override {
        return mMap.logProfile.data() + texel * mValues;
    }

private:
    const MaterialMap& mMap;
    std::size_t mValues;
};

} // namespace celadon::subedit
