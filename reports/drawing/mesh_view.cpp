#include "reports/drawing/mesh_view.h"

#include <algorithm>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr double kNear_m = 0.1, kFar_m = 50.0;

// A skin without gloss: shape shows, and colours that mean a number stay readable.
constexpr double kAmbient = 0.45, kDiffuse = 0.75;

// OpenGL's projection for the part of the picture (column vectors; eye x right, y up, −z forward).
vtkNew<vtkMatrix4x4> Projection(const PinholeCamera& camera, const PictureWindow& part) {
  constexpr double kHalfPixel = 0.5;  // the camera counts from the first pixel's centre
  const double left = (part.left - kHalfPixel - camera.cx) / camera.fx;
  const double right = left + part.width / camera.fx;
  const double top = -(part.top - kHalfPixel - camera.cy) / camera.fy;
  const double bottom = top - part.height / camera.fy;
  vtkNew<vtkMatrix4x4> m;
  m->Zero();
  m->SetElement(0, 0, 2.0 / (right - left));
  m->SetElement(0, 2, (right + left) / (right - left));
  m->SetElement(1, 1, 2.0 / (top - bottom));
  m->SetElement(1, 2, (top + bottom) / (top - bottom));
  m->SetElement(2, 2, -(kFar_m + kNear_m) / (kFar_m - kNear_m));
  m->SetElement(2, 3, -2.0 * kFar_m * kNear_m / (kFar_m - kNear_m));
  m->SetElement(3, 2, -1.0);
  return m;
}

vtkNew<vtkPolyData> ToVtk(const ShadedMesh& mesh) {
  const auto& vertices = *mesh.vertices;
  std::vector<Vector3f> vertex_normals;
  ComputeVertexNormals(vertices, *mesh.triangles, vertex_normals);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colors;
  normals->SetNumberOfComponents(3);
  colors->SetNumberOfComponents(3);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    points->InsertNextPoint(vertices[v].data());
    normals->InsertNextTuple(vertex_normals[v].data());
    const Color& color = mesh.colors[mesh.colors.size() == 1 ? 0 : v];
    colors->InsertNextTypedTuple(color.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : *mesh.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetNormals(normals);
  data->GetPointData()->SetScalars(colors);
  return data;
}

vtkNew<vtkActor> ToActor(const ShadedMesh& mesh) {
  Require(mesh.colors.size() == 1 || mesh.colors.size() == mesh.vertices->size(),
          "expected 1 or {} colours, got {}", mesh.vertices->size(), mesh.colors.size());
  const vtkNew<vtkPolyData> data = ToVtk(mesh);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(kAmbient);
  actor->GetProperty()->SetDiffuse(kDiffuse);
  actor->GetProperty()->SetSpecular(0.0);
  return actor;
}

// On outlines the black background is mixed into the colours, by as much as it shows through.
ColorImage WithoutBackground(ColorImage image) {
  for (ColorPixel& pixel : image.pixels()) {
    if (pixel[3] == 0) continue;
    for (int c = 0; c < 3; ++c) {
      pixel[c] = static_cast<std::uint8_t>(std::min(255, pixel[c] * 255 / pixel[3]));
    }
  }
  return image;
}

}  // namespace

struct MeshView::Scene {
  Scene(int width, int height) : window(width, height) {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 0.0);
    camera->SetFocalPoint(0.0, 0.0, 1.0);
    camera->SetViewUp(0.0, -1.0, 0.0);
    camera->SetUseExplicitProjectionTransformMatrix(true);
    // From over the camera's left shoulder, with a weaker one from the right.
    AddLight({-0.6, -0.8, -1.0}, 0.75);
    AddLight({1.2, 0.1, -0.8}, 0.3);
    renderer->SetAutomaticLightCreation(false);
    renderer->SetBackground(0.0, 0.0, 0.0);
    renderer->SetBackgroundAlpha(0.0);
    window.vtk().AddRenderer(renderer);
  }
  // Shines from `position` (camera frame, towards the origin) as from very far.
  void AddLight(const std::array<double, 3>& position, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(false);
    light->SetPosition(position[0], position[1], position[2]);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  }

  vtkNew<vtkRenderer> renderer;
  OffscreenWindow window;  // goes first: it frees what the renderer holds in its context
};

MeshView::MeshView(int width, int height) : scene_(std::make_unique<Scene>(width, height)) {}
MeshView::~MeshView() = default;

ColorImage MeshView::Draw(const PinholeCamera& camera, const PictureWindow& part,
                          const std::vector<ShadedMesh>& meshes) {
  vtkRenderer& renderer = *scene_->renderer;
  renderer.RemoveAllViewProps();
  for (const ShadedMesh& mesh : meshes) renderer.AddActor(ToActor(mesh));
  renderer.GetActiveCamera()->SetExplicitProjectionTransformMatrix(Projection(camera, part));
  renderer.GetActiveCamera()->SetClippingRange(kNear_m, kFar_m);
  return WithoutBackground(scene_->window.DrawAndRead());
}

ColorImage OnWhite(ColorImage image) {
  for (ColorPixel& pixel : image.pixels()) {
    for (int c = 0; c < 3; ++c) {
      pixel[c] = static_cast<std::uint8_t>((pixel[c] * pixel[3] + 255 * (255 - pixel[3])) / 255);
    }
    pixel[3] = 255;
  }
  return image;
}

}  // namespace vitruvia
