#include "methods/external/settings.h"

namespace vitruvia::external {

void Settings::Describe(Fields& f) {
  f.File("program", program,
         {.meaning = "the program, which follows src/methods/external/PROTOCOL.md: an executable "
                     "file, or a script with a #! line",
          .required = true});
  f.Texts("arguments", arguments, {.meaning = "arguments of the program"});
  f.Number("answer_within_s", answer_within_s,
           {.meaning = "time limit for the answer to a frame or to the start message, after which "
                       "the program counts as hung",
            .unit = "s",
            .min = 0.01,
            .max = 86400});
}

}  // namespace vitruvia::external
