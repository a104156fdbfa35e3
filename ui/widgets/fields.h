#pragma once

#include <string>

/// Small widgets with a label above or beside, a unit and a tooltip; each returns whether the value
/// was changed just now.
namespace celadon::ui {

/// Shows `text` while the cursor is on the last widget; null or empty: nothing.
void tooltip(const char* text);
void heading(const char* text);
/// Muted, wrapped text.
void hint(const char* text);

bool sliderField(const char* label, float& value, float least, float most, const char* format,
                 const char* help, bool logarithmic = false);
bool sliderField(const char* label, int& value, int least, int most, const char* format,
                 const char* help);
/// Something to be typed; taken when the field is left.
bool textField(const char* label, std::string& text, const char* help);
/// @param rgb linear; the swatch and its picker show it as a screen does
/// @param isTint  only ratios count: what is picked is as bright as can be, and never black
bool colorField(const char* label, float rgb[3], const char* help, bool isTint = false);
/// A row of words of which one is chosen. @return index that was clicked, -1: none
int choiceRow(const char* id, const char* const* labels, const char* const* helps, int count,
              int current);
/// The name of a row of a list, up to buttons that follow; as high as they are.
/// @param buttons square ones, each after sameRow() @return whether it was clicked
bool rowName(const char* label, bool isChosen, int buttons);
/// The next item goes on in a row that rowName() has begun.
void sameRow();
/// A name and a value, for readouts.
void readout(const char* name, const std::string& value, const char* help);

} // namespace celadon::ui
