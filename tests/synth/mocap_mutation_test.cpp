// Some hundred damaged BVH, ASF and AMC files, seeded. Each is refused with its file named, or read
// with a warning, or gives the motion of the whole file.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "math/rigid.h"
#include "mocap_support.h"

namespace vitruvia {
namespace {

constexpr int kMutations = 350;  // of each format

// A file in lines of words; words are what a mutation replaces, so that numbers can be left alone.
using Lines = std::vector<std::vector<std::string>>;

Lines LinesOf(const std::string& text) {
  Lines lines(1);
  std::string word;
  for (const char c : text) {
    if (c != ' ' && c != '\n') {
      word += c;
      continue;
    }
    if (!word.empty()) lines.back().push_back(std::move(word));
    word.clear();
    if (c == '\n') lines.emplace_back();
  }
  return lines;
}

std::string TextOf(const Lines& lines) {
  std::string text;
  for (const auto& line : lines) {
    for (const std::string& word : line) text += word + " ";
    text += "\n";
  }
  return text;
}

bool IsNumber(const std::string& word) {
  return word.find_first_not_of("+-.0123456789eE") == std::string::npos;
}

// Junk that is no number, so that no number becomes another one.
std::string Damaged(std::string word, RandomStream& random) {
  static const std::string kJunk = "#,;xX_{}()\xEF\x80\x01";
  const std::size_t at = random.Index(word.size());
  const char junk = kJunk[random.Index(kJunk.size())];
  switch (random.Index(3)) {
    case 0:
      word[at] = junk;
      return word;
    case 1:
      return word.substr(0, at) + junk + word.substr(at);
    default:
      return IsNumber(word) ? word + junk : word.erase(at, 1);
  }
}

// What changed the meaning of a file, if anything did; numbers are never replaced by others, and
// lines are not exchanged where the format has the same line many times (one frame for another).
void Mutate(Lines& lines, RandomStream& random) {
  std::size_t at = 0;
  do at = random.Index(lines.size());
  while (lines[at].empty());
  std::vector<std::string>& line = lines[at];
  const std::size_t word = random.Index(line.size());
  const auto line_at = lines.begin() + static_cast<std::ptrdiff_t>(at);
  const auto word_at = line.begin() + static_cast<std::ptrdiff_t>(word);
  switch (random.Index(7)) {
    case 0:
    case 1:
    case 2:
      line[word] = Damaged(line[word], random);
      return;
    case 3:
      line.erase(word_at);
      return;
    case 4:
      line.insert(word_at, line[word]);
      return;
    case 5:
      lines.erase(line_at);
      return;
    default:
      lines.insert(line_at, std::vector<std::string>(line));
      return;
  }
}

struct Outcomes {
  int refused = 0, told = 0, same = 0;
};

// `load` reads the mutant's text.
template <class Load>
Outcomes TryMutants(const std::string& text, const Motion& whole, const std::string& name,
                    Load&& load) {
  const Lines lines = LinesOf(text);
  Outcomes outcomes;
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(3, fmt::format("{}/{}", name, i));
    Lines mutant = lines;
    Mutate(mutant, random);
    const std::string mutated = TextOf(mutant);
    try {
      const std::unique_ptr<Motion> motion = load(mutated);
      if (Difference(*motion, whole) < 1e-12) {
        ++outcomes.same;
      } else {
        ++outcomes.told;
        EXPECT_FALSE(motion->warnings().empty())
            << name << "/" << i << " is read without a word, and the motion differs";
        if (motion->warnings().empty()) {
          for (std::size_t line = 0; line < std::max(lines.size(), mutant.size()); ++line) {
            if (line < lines.size() && line < mutant.size() && lines[line] == mutant[line])
              continue;
            ADD_FAILURE() << "line " << line + 1 << ": "
                          << fmt::format("{}", fmt::join(mutant[line], " "));
            break;
          }
        }
      }
    } catch (const Error& error) {
      ++outcomes.refused;
      EXPECT_NE(std::string(error.what()).find("clip."), std::string::npos) << error.what();
    }
  }
  return outcomes;
}

std::vector<TestFrame> FewFrames() {
  std::vector<TestFrame> frames = Wriggle();
  frames.resize(4);
  return frames;
}

TEST(MocapMutation, DamagedBvhFilesAreNotReadInSilence) {
  const std::string text = TestBvh(TestSkeleton()).Text(FewFrames());
  const auto whole = FromBvh(text);
  const Outcomes outcomes =
      TryMutants(text, *whole, "bvh", [](const std::string& mutant) { return FromBvh(mutant); });
  EXPECT_GT(outcomes.refused, kMutations / 2);
  EXPECT_GT(outcomes.same, 0);
}

std::string FewAmcFrames() {
  return Amc(AmcFrame(1, {{"head", "0 40 0"}}) +
             AmcFrame(2, {{"lfemur", "-30 0 -20"}, {"lradius", "20"}}) +
             AmcFrame(3, {{"rfemur", "-30 0 20"}, {"rtibia", "25"}, {"root", "0 17 1 0 5 0"}}));
}

TEST(MocapMutation, DamagedAmcFilesAreNotReadInSilence) {
  const auto whole = FromAmc(FewAmcFrames());
  const Outcomes outcomes = TryMutants(FewAmcFrames(), *whole, "amc",
                                       [](const std::string& mutant) { return FromAmc(mutant); });
  EXPECT_GT(outcomes.refused, kMutations / 2);
  EXPECT_GT(outcomes.same, 0);
}

TEST(MocapMutation, DamagedAsfFilesAreNotReadInSilence) {
  const auto whole = FromAmc(FewAmcFrames());
  const Outcomes outcomes = TryMutants(kTestAsf, *whole, "asf", [](const std::string& mutant) {
    return FromAmc(FewAmcFrames(), mutant);
  });
  EXPECT_GT(outcomes.refused, kMutations / 3);
  EXPECT_GT(outcomes.same, 0);
}

// Bytes of any kind, and files cut anywhere: no crash, no hang.
TEST(MocapMutation, AnyBytesAreRefusedOrRead) {
  const std::string bvh = TestBvh(TestSkeleton()).Text(FewFrames());
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(4, std::to_string(i));
    std::string mutant =
        bvh.substr(0, random.Index(2) == 0 ? random.Index(bvh.size()) : bvh.size());
    for (int changes = 0; changes < 3 && !mutant.empty(); ++changes) {
      mutant[random.Index(mutant.size())] = static_cast<char>(random.Index(256));
    }
    try {
      FromBvh(mutant)->At(0.01);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("clip.bvh"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace vitruvia
