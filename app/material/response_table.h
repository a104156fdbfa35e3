#pragma once

#include "subedit/fit/response_fit.h"

#include <filesystem>
#include <string_view>
#include <vector>

/// Measured responses as files hold them.
namespace celadon::app {

/// A CSV with a header that names its columns, in any order: `u_in v_in u_out v_out R G B`, and
/// either `r_mm` or the positions `x_in y_in z_in x_out y_out z_out` in mm. Other columns are left
/// out.
/// @throws InputError naming the line or the missing column
[[nodiscard]] std::vector<subedit::ResponseSample> parseResponseCsv(std::string_view text,
                                                                    const std::string& name);

struct ResponseImages {
    double extentMm = 0.0; ///< width of what each image shows, of a flat sample
    double scale = 1.0;    ///< R_d in 1/mm^2 of a pixel value 1
    double darkest = 1e-4; ///< pixels darker than this part of the brightest are left out
    std::size_t mostSamples = 2'000'000;
};

/// A CSV `file,u,v`: images of one flat sample under illumination of the point (u, v) each, all of
/// the same framing; files are found from the list's folder. Every pixel is a pair of points; of
/// too many, evenly every n-th is taken.
/// @throws InputError
[[nodiscard]] std::vector<subedit::ResponseSample>
readResponseImages(const std::filesystem::path& list, const ResponseImages& settings);

/// The whole file. @throws InputError if it cannot be read or is over 1 GB
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file);

} // namespace celadon::app
