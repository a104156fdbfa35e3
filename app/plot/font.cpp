#include "app/plot/font.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_truetype.h>
#pragma GCC diagnostic pop

// The font file as it is, between two symbols (GNU assembler).
asm(R"(.section .rodata
.balign 16
.globl celadon_plot_font
celadon_plot_font:
.incbin ")" CELADON_PLOT_FONT R"("
.byte 0
.previous
)");
extern "C" const unsigned char celadon_plot_font[];

namespace celadon::plot {

namespace {

constexpr int kCurveSteps = 4;

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo info = [] {
        stbtt_fontinfo made;
        stbtt_InitFont(&made, celadon_plot_font, 0);
        return made;
    }();
    return info;
}

double fontScale(double size) {
    return static_cast<double>(stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size)));
}

/// The next code point; broken bytes become the replacement character.
int nextCodePoint(std::string_view text, std::size_t& at) {
    constexpr int kReplacement = 0xfffd;
    const auto lead = static_cast<unsigned char>(text[at++]);
    if (lead < 0x80) {
        return lead;
    }
    const int following = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : -1;
    if (following < 0) {
        return kReplacement;
    }
    int code = lead & (0x3f >> following);
    for (int i = 0; i < following; ++i) {
        if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80) {
            return kReplacement;
        }
        code = (code << 6) | (static_cast<unsigned char>(text[at++]) & 0x3f);
    }
    return code;
}

/// Calls visit(glyph, x in font units) for each character; @return the whole width.
template<typename Visit>
int layOut(std::string_view text, const Visit& visit) {
    int x = 0;
    int previous = 0;
    for (std::size_t at = 0; at < text.size();) {
        const int glyph = stbtt_FindGlyphIndex(&font(), nextCodePoint(text, at));
        if (previous != 0) {
            x += stbtt_GetGlyphKernAdvance(&font(), previous, glyph);
        }
        visit(glyph, x);
        int advance = 0;
        int bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        x += advance;
        previous = glyph;
    }
    return x;
}

void appendGlyph(int glyph, int x, double scale, std::vector<std::vector<glm::dvec2>>& outlines) {
    stbtt_vertex* vertices = nullptr;
    const int count = stbtt_GetGlyphShape(&font(), glyph, &vertices);
    const auto place = [&](double vx, double vy) {
        return glm::dvec2((x + vx) * scale, -vy * scale);
    };
    for (int i = 0; i < count; ++i) {
        const stbtt_vertex& vertex = vertices[i];
        const glm::dvec2 to = place(vertex.x, vertex.y);
        if (vertex.type == STBTT_vmove) {
            outlines.push_back({to});
        } else if (vertex.type == STBTT_vline) {
            outlines.back().push_back(to);
        } else { // TrueType outlines are lines and quadratic curves
            const glm::dvec2 from = outlines.back().back();
            const glm::dvec2 control = place(vertex.cx, vertex.cy);
            for (int step = 1; step <= kCurveSteps; ++step) {
                const double t = static_cast<double>(step) / kCurveSteps;
                outlines.back().push_back((1.0 - t) * (1.0 - t) * from +
                                          2.0 * t * (1.0 - t) * control + t * t * to);
            }
        }
    }
    stbtt_FreeShape(&font(), vertices);
}

} // namespace

double textWidth(std::string_view text, double size) {
    return layOut(text, [](int, int) {}) * fontScale(size);
}

std::vector<std::vector<glm::dvec2>> textOutlines(std::string_view text, double size) {
    std::vector<std::vector<glm::dvec2>> outlines;
    const double scale = fontScale(size);
    layOut(text, [&](int glyph, int x) { appendGlyph(glyph, x, scale, outlines); });
    return outlines;
}

} // namespace celadon::plot
