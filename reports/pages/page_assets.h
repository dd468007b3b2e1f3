// Style and script of the report page.
#pragma once

namespace vitruvia {

extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace vitruvia
