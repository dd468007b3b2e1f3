// Style, body and scripts of the viewer's page: the files beside this one, and three.js.
#pragma once

namespace vitruvia {

extern const char* const kThreeScript;
extern const char* const kViewerStyle;
extern const char* const kViewerBody;
// Each goes into an element of its own, in this order.
extern const char* const kViewerDataScript;      // arrays of the page
extern const char* const kViewerStageScript;     // the three-dimensional picture
extern const char* const kViewerTimelineScript;  // numbers over time
extern const char* const kViewerScript;          // state, controls, keys

}  // namespace vitruvia
