#include "methods/external/settings.h"

namespace vitruvia::external {

void Settings::Describe(Fields& f) {
  f.File("program", program,
         {.meaning = "the program, as src/methods/external/PROTOCOL.md wants it: an executable "
                     "file, or a script with a #! line",
          .required = true});
  f.Texts("arguments", arguments, {.meaning = "what it is called with"});
  f.Number("answer_within_s", answer_within_s,
           {.meaning = "how long it may take for a frame, or to get ready, before it counts as "
                       "hung",
            .unit = "s",
            .min = 0.01,
            .max = 86400});
}

}  // namespace vitruvia::external
