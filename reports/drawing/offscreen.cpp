#include "reports/drawing/offscreen.h"

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <GL/osmesa.h>
#include <fmt/format.h>
#include <vtkBase64Utilities.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

// Debian builds VTK and GLEW for X: they look OpenGL's functions up through GLX and ask GLX for a
// display before they believe in a context. The program answers these questions itself, so that
// they see OSMesa's functions and a GLX without extensions. The linker keeps the five in the
// executable's dynamic symbols (CMakeLists.txt), where they come before those of libGLX.
extern "C" {
using GlFunction = void (*)();

static void* StandInDisplay() {
  static int display;
  return &display;
}
GlFunction glXGetProcAddressARB(const unsigned char* name) {
  const std::string_view text(reinterpret_cast<const char*>(name));
  if (text == "glXGetCurrentDisplay") return reinterpret_cast<GlFunction>(&StandInDisplay);
  return OSMesaGetProcAddress(text.data());
}
GlFunction glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }
int glXQueryVersion(void* /*display*/, int* major, int* minor) {
  *major = 1;
  *minor = 4;
  return 1;
}
const char* glXGetClientString(void* /*display*/, int /*name*/) { return ""; }
}

namespace vitruvia {
namespace {

constexpr int kSamples = 4;  // per pixel, for smooth edges; the most that OSMesa offers

// The window asks its host about the context; ours is always there and current.
void AnswerWindow(vtkObject* /*window*/, unsigned long event, void* /*client*/, void* answer) {
  if (event == vtkCommand::WindowIsDirectEvent) {
    *static_cast<int*>(answer) = 1;
  } else {
    *static_cast<bool*>(answer) = true;
  }
}

OSMesaContext MakeContext() {
  // VTK 9.1 needs OpenGL 3.2.
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_STENCIL_BITS,
                            8,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  const OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (context == nullptr) throw std::runtime_error("OSMesa makes no OpenGL 3.3 context");
  return context;
}

}  // namespace

struct OffscreenWindow::Context {
  Context(int width, int height) {
    MakeCurrent();
    vtkNew<vtkCallbackCommand> answers;
    answers->SetCallback(AnswerWindow);
    for (const auto event :
         {vtkCommand::WindowIsCurrentEvent, vtkCommand::WindowSupportsOpenGLEvent,
          vtkCommand::WindowIsDirectEvent}) {
      window->AddObserver(event, answers);
    }
    window->SetReadyForRendering(true);
    window->SetOwnContext(0);
    window->SetMultiSamples(kSamples);
    window->SetAlphaBitPlanes(1);
    window->SetSize(width, height);
    window->SetDPI(72);  // one point is one pixel
    window->OpenGLInitContext();
  }
  ~Context() {
    MakeCurrent();
    window->Finalize();
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(mesa);
  }
  void MakeCurrent() {
    if (OSMesaMakeCurrent(mesa, unused.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
      throw std::runtime_error("OSMesa does not make its context current");
    }
  }

  OSMesaContext mesa = MakeContext();
  std::array<std::uint8_t, 4> unused{};  // OSMesa's own buffer; VTK draws into buffer objects
  vtkNew<vtkGenericOpenGLRenderWindow> window;
};

OffscreenWindow::OffscreenWindow(int width, int height)
    : context_(std::make_unique<Context>(width, height)) {}
OffscreenWindow::~OffscreenWindow() = default;

vtkRenderWindow& OffscreenWindow::vtk() { return *context_->window; }

void OffscreenWindow::Resize(int width, int height) {
  context_->MakeCurrent();
  context_->window->SetSize(width, height);
}

void OffscreenWindow::Draw() {
  context_->MakeCurrent();
  context_->window->Render();
}

ColorImage OffscreenWindow::DrawAndRead() {
  Draw();
  const int* size = context_->window->GetSize();
  const int width = size[0], height = size[1];
  vtkNew<vtkUnsignedCharArray> rows;  // bottom row first
  constexpr int kBackBuffer = 0;
  context_->window->GetRGBACharPixelData(0, 0, width - 1, height - 1, kBackBuffer, rows);
  ColorImage image(width, height);
  for (int v = 0; v < height; ++v) {
    std::memcpy(&image(0, v), rows->GetPointer(4 * static_cast<vtkIdType>(height - 1 - v) * width),
                sizeof(ColorPixel) * static_cast<std::size_t>(width));
  }
  return image;
}

std::string EncodePng(const ColorImage& image) {
  bool opaque = true;
  for (const ColorPixel& pixel : image.pixels()) opaque = opaque && pixel[3] == 255;
  const int channels = opaque ? 3 : 4;
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width(), image.height(), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  for (int v = 0; v < image.height(); ++v) {
    auto* row = static_cast<std::uint8_t*>(data->GetScalarPointer(0, image.height() - 1 - v, 0));
    for (int u = 0; u < image.width(); ++u) {
      for (int c = 0; c < channels; ++c) *row++ = image(u, v)[c];
    }
  }
  constexpr int kCompression = 7;  // 0 … 9; beyond, files hardly shrink
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetCompressionLevel(kCompression);
  writer->SetWriteToMemory(true);
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  return {reinterpret_cast<const char*>(result->GetPointer(0)),
          static_cast<std::size_t>(result->GetNumberOfValues())};
}

std::string DataUri(const std::string& png) {
  std::string text(4 * ((png.size() + 2) / 3), '\0');
  const auto* bytes = reinterpret_cast<const unsigned char*>(png.data());
  vtkBase64Utilities::Encode(bytes, png.size(), reinterpret_cast<unsigned char*>(text.data()));
  return "data:image/png;base64," + text;
}

}  // namespace vitruvia
