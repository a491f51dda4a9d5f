// SPDX-License-Identifier: Apache-2.0
// Hair texture against ParaView's surface LIC, where pvpython is installed: the same mesh and directions, as many
// steps.
#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "core/field/groom_field.h"
#include "core/lic/painter.h"
#include "editor/cli/bench_grooms.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace whorl {

std::vector<BenchRow> benchParaview();

namespace {

namespace fs = std::filesystem;

constexpr int pixels = 1024;
constexpr int stepsEachWay = 20;

// Where a program lies that PATH leads to; empty when there is none.
fs::path programIn(const char* name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        fs::path file = fs::path(folder) / name;
        if (::access(file.c_str(), X_OK) == 0 && !fs::is_directory(file)) return file;
    }
    return {};
}

void writeMesh(const SurfaceMesh& mesh, std::span<const glm::vec3> directions, const fs::path& file) {
    std::ofstream out(file);
    out << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS " << mesh.positions.size() << " float\n";
    for (const glm::vec3& p : mesh.positions) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
    out << "POLYGONS " << mesh.triangles.size() << ' ' << 4 * mesh.triangles.size() << '\n';
    for (const glm::uvec3& t : mesh.triangles) out << "3 " << t.x << ' ' << t.y << ' ' << t.z << '\n';
    out << "POINT_DATA " << directions.size() << "\nVECTORS way float\n";
    for (const glm::vec3& d : directions) out << d.x << ' ' << d.y << ' ' << d.z << '\n';
}

// Draws one frame more than seven, each from another side, and writes the median of their times. The arrays that it
// draws from are there before; a pixel is a step, so that the kernel is as long as ours.
void writeScript(const fs::path& folder) {
    std::ofstream out(folder / "lic.py");
    out << "import time\n"
           "from paraview.simple import *\n"
           "mesh = LegacyVTKReader(FileNames=['mesh.vtk'])\n"
           "view = CreateView('RenderView')\n"
           "view.ViewSize = ["
        << pixels << ", " << pixels << "]\n"
        << "shown = Show(mesh, view)\n"
           "shown.SetRepresentationType('Surface LIC')\n"
           "shown.SelectInputVectors = ['POINTS', 'way']\n"
           "shown.NumberOfSteps = "
        << stepsEachWay << "\n"
        << "shown.StepSize = 1.0\n"
           "view.ResetCamera()\n"
           "times = []\n"
           "for i in range(8):\n"
           "    view.CameraPosition = [0.01 * i, 0.0, 0.36]\n"
           "    start = time.perf_counter()\n"
           "    Render(view)\n"
           "    times.append(time.perf_counter() - start)\n"
           "SaveScreenshot('lic.png', view)\n"
           "if shown.Representation != 'Surface LIC': raise SystemExit(1)\n"
           "with open('seconds', 'w') as file: file.write(str(sorted(times[1:])[3]))\n";
}

// Median of a frame, seconds, or in `words` why there is none.
double paraviewSeconds(const SurfaceMesh& mesh, std::span<const glm::vec3> directions, std::string& words) {
    const fs::path program = programIn("pvpython");
    if (program.empty()) {
        words = "not compared with ParaView: there is no pvpython in PATH";
        return 0.0;
    }
    std::string command = "LIBGL_ALWAYS_SOFTWARE=1 timeout 300 ";
    if (std::getenv("DISPLAY") == nullptr) {
        if (programIn("xvfb-run").empty()) {
            words = "not compared with ParaView: it needs a display, or xvfb-run in PATH";
            return 0.0;
        }
        command += "xvfb-run -a -s '-screen 0 1280x1100x24' ";
    }
    std::error_code failed;
    const fs::path folder = fs::temp_directory_path() / ("whorl-bench-paraview-" + std::to_string(::getpid()));
    fs::create_directories(folder, failed);
    writeMesh(mesh, directions, folder / "mesh.vtk");
    writeScript(folder);
    command = "cd '" + folder.string() + "' && " + command + "pvpython lic.py > said 2>&1";
    double seconds = 0.0;
    const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): a path that we made ourselves
    std::ifstream(folder / "seconds") >> seconds;
    if (status != 0 || !(seconds > 0.0)) {
        words = "not compared with ParaView: its pvpython failed; run it on " + (folder / "lic.py").string();
        return 0.0;
    }
    fs::remove_all(folder, failed);
    return seconds;
}

}  // namespace

std::vector<BenchRow> benchParaview() {
    Groom groom = benchGroom();
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Progress progress;
    BenchRow row;
    row.name = "paraview/hair texture 1024^2, 69k triangles, length 40";
    const auto field = groomField(groom, surface, progress);
    const auto painter = LicPainter::make(surface, pixels, progress);
    if (!field || !painter) return {row};
    LicParams& lic = groom.lic.edit();
    lic.length.value = stepsEachWay * painter->atlas().usualTexel();
    LicTexture texture;
    const ThreadLimit limit(2);
    const Medians seconds = interleaved(
        [&] {
            // All of it, along another length.
            lic.length.value *= 1.0001f;
            if (auto painted = painter->paint(groom, *field, &texture, progress)) texture = std::move(*painted);
        },
        {});
    row.seconds = seconds.ours;
    row.items = 1.0;
    row.unit = "textures";
    row.note = std::string("2 threads, ") + simdLevelName(simdLevel());
    row.correct = texture.size == pixels && field->vertices().size() == groom.mesh->positions.size();
    std::string words;
    row.baselineSeconds = paraviewSeconds(*groom.mesh, field->vertices(), words);
    if (row.baselineSeconds > 0.0) {
        row.baseline = "a frame of ParaView's surface LIC, drawn by the processor; the ball fills most of the picture";
    } else {
        row.note += "; " + words;
    }
    return {row};
}

}  // namespace whorl
