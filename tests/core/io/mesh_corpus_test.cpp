// SPDX-License-Identifier: Apache-2.0
// Every importer on the real files of $WHORL_TEST_DATA.
#include "core/io/mesh_import.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

std::vector<std::vector<std::string>> table(const fs::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells;
        std::istringstream words(line);
        for (std::string cell; std::getline(words, cell, '\t');) cells.push_back(cell);
        rows.push_back(cells);
    }
    return rows;
}

Result<ImportedMesh> load(const fs::path& file) {
    Progress progress;
    return importMesh(file, progress, {.textures = false});
}

// What SurfaceMesh promises, and sentences where something was refused; empty when all is well.
std::string fault(const fs::path& file, const Result<ImportedMesh>& got) {
    const std::string name = file.filename().string();
    if (!got) {
        const std::string& text = got.error().message;
        return text.size() > 10 && text.back() == '.' && text.find('\n') == std::string::npos
                   ? ""
                   : name + " refused with: " + text;
    }
    const SurfaceMesh& mesh = got->mesh;
    if (mesh.triangles.empty() || mesh.cornerUvs.size() != mesh.triangles.size() * 3 ||
        mesh.normals.size() != mesh.positions.size()) {
        return name + ": arrays do not match";
    }
    for (const glm::vec3& n : mesh.normals) {
        if (!(std::abs(glm::dot(n, n) - 1.0f) < 1e-3f)) return name + ": a normal is not of unit length";
    }
    for (const glm::vec2& uv : mesh.cornerUvs) {
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return name + ": a UV is not finite";
    }
    std::uint32_t next = 0;
    for (const MeshPart& part : mesh.parts) {
        if (part.firstTriangle != next) return name + ": parts are not contiguous";
        next += part.triangleCount;
    }
    if (next != mesh.triangleCount()) return name + ": parts do not cover";
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if (!(triangleArea(mesh, t) > 0.0)) return name + ": a triangle without area";
    }
    return {};
}

// What the validator finds valid and Whorl refuses, with the reason: compressed meshes, required extensions that nobody
// knows, buffers that are not in the corpus, and the validator's own files of zeros.
const std::map<std::string, std::string>& refusedThoughValid() {
    static const std::map<std::string, std::string> files{
        {"gltf_valid/gltf_transform/cli/test/in/ACMEBox.gltf", "ACME_gizmo"},
        {"gltf_valid/gltf_pipeline/extensions/EXT_meshopt_compression/meshopt-no-fallback/meshopt-no-fallback.gltf",
         "EXT_meshopt_compression"},
        {"gltf_valid/gltf_transform/extensions/test/in/BoxMeshopt.glb", "EXT_meshopt_compression"},
        {"gltf_valid/gltf_transform/extensions/test/in/BoxMeshopt.gltf", "EXT_meshopt_compression"},
        {"gltf_valid/asset_generator/Compatibility/Compatibility_05.gltf", "FAKE_materials_quantumRendering"},
        {"gltf_mixed/assimp/draco/2CylinderEngine.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/gltf_transform/extensions/test/in/BoxDraco.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/gltf_transform/extensions/test/in/DracoSparseMesh.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/gltf_transform/functions/test/in/DenseSphere.glb", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/Avocado/glTF-Draco/Avocado.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/Box/glTF-Draco/Box.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/MorphPrimitivesTest/glTF-Draco/MorphPrimitivesTest.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/RiggedFigure/glTF-Draco/RiggedFigure.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/RiggedSimple/glTF-Draco/RiggedSimple.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/khronos/WaterBottle/glTF-Draco/WaterBottle.gltf", "KHR_draco_mesh_compression"},
        {"gltf_valid/gltf_pipeline/extensions/KHR_meshopt_compression/meshopt-no-fallback/meshopt-no-fallback.gltf",
         "KHR_meshopt_compression"},
        {"gltf_invalid/khronos_validator/base/data/mesh/custom_property.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/mesh/primitive_generated_tangent_space.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/mesh/primitive_incompatible_mode.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/mesh_data/index_buffer_degenerate_triangle.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/node/node_skinned_mesh_without_skin.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/node/node_weights_override.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/node/valid.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/skin/ignored_animated_transform.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/skin/ignored_local_transform.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/skin/ignored_parent_transform.gltf", "has no data"},
        {"gltf_invalid/khronos_validator/base/data/mesh/valid.gltf", "invalid bufferView"},
        {"gltf_invalid/khronos_validator/base/data/json/integer_written_as_float.gltf", "name is empty"},
        {"gltf_invalid/khronos_validator/base/data/root/named_objects.gltf", "name is empty"},
        {"gltf_invalid/khronos_validator/base/data/root/unused_objects.gltf", "name is empty"},
        {"gltf_valid/blender_io/01_vertex_count_16bit/01_vertex_count_16bit.gltf", "no such file"},
        {"gltf_valid/blender_io/01_vertex_count_32bit/01_vertex_count_32bit.gltf", "no such file"},
        {"gltf_invalid/khronos_validator/base/data/mesh/primitive_no_position.gltf", "no triangles"},
    };
    return files;
}

std::vector<fs::path> meshesIn(const fs::path& folder) {
    static const std::set<std::string> suffixes{".gltf", ".glb", ".obj", ".ply", ".off", ".stl"};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && suffixes.count(entry.path().extension().string()) != 0)
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

class MeshCorpusTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void hostile() {
        const auto folder = testing::realData("hostile");
        if (!folder) QSKIP("the folder of hostile files is not here");
        int checked = 0;
        for (const auto& row : table(*folder / "INDEX.tsv")) {
            const fs::path file = *folder / row[0];
            const std::string kind = row[0].substr(0, row[0].find('/'));
            if (kind != "gltf" && kind != "obj" && kind != "ply") continue;
            QElapsedTimer timer;
            timer.start();
            const auto got = load(file);
            QVERIFY2(timer.elapsed() < 2000, row[0].c_str());
            QVERIFY2(fault(file, got).empty(), fault(file, got).c_str());
            const std::string& expected = row[3];
            if (expected == "REJECT") QVERIFY2(!got.ok(), row[0].c_str());
            if (expected == "LOAD") QVERIFY2(got.ok(), row[0].c_str());
            if (expected == "LOAD+WARN") QVERIFY2(got.ok(), row[0].c_str());
            if (expected == "REPAIR") QVERIFY2(got.ok() && !got->problems.empty(), row[0].c_str());
            ++checked;
        }
        QVERIFY(checked > 40);
    }

    // The Khronos validator's word: what it finds without errors has the right number of triangles here.
    void oracle() {
        const auto file = testing::realData("GLTF_ORACLE.tsv");
        if (!file) QSKIP("the validator's verdicts are not here");
        int agreed = 0;
        for (const auto& row : table(*file)) {
            if (row.size() < 6 || row[1] != "0" || row[5].empty() || row[0].substr(0, 5) != "gltf_") continue;
            const fs::path mesh = file->parent_path() / row[0];
            const auto triangles = std::stoul(row[5]);
            const auto got = load(mesh);
            QVERIFY2(fault(mesh, got).empty(), fault(mesh, got).c_str());
            if (got) {
                QVERIFY2(got->sourceTriangles == triangles, row[0].c_str());
                ++agreed;
                continue;
            }
            if (triangles == 0) continue;
            const auto known = refusedThoughValid().find(row[0]);
            QVERIFY2(known != refusedThoughValid().end(), got.error().message.c_str());
            QVERIFY2(got.error().message.find(known->second) != std::string::npos, got.error().message.c_str());
        }
        QVERIFY2(agreed >= 390, qPrintable(QString::number(agreed)));
    }

    void everyFileLoadsOrIsRefused_data() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"gltf_invalid", "gltf_mixed", "mesh_edge"}) QTest::newRow(name) << name;
    }
    void everyFileLoadsOrIsRefused() {
        QFETCH(QString, name);
        const auto folder = testing::realData(name.toStdString());
        if (!folder) QSKIP("that folder is not here");
        const auto files = meshesIn(*folder);
        QVERIFY(!files.empty());
        for (const fs::path& file : files) {
            QElapsedTimer timer;
            timer.start();
            const auto got = load(file);
            QVERIFY2(fault(file, got).empty(), fault(file, got).c_str());
            QVERIFY2(timer.elapsed() < 4000, file.c_str());
        }
    }

    void everyGoodMeshLoads_data() { everyFileLoadsOrIsRefused_rows(); }
    void everyGoodMeshLoads() {
        QFETCH(QString, name);
        const auto folder = testing::realData(name.toStdString());
        if (!folder) QSKIP("that folder is not here");
        for (const fs::path& file : meshesIn(*folder)) {
            const auto got = load(file);
            QVERIFY2(got.ok(), got ? "" : got.error().message.c_str());
            QVERIFY2(fault(file, got).empty(), fault(file, got).c_str());
            QCOMPARE(got->mesh.triangleCount(), got->sourceTriangles);
        }
    }

    void sameHeadFromObjAndGlb() {
        const auto folder = testing::realData("heads/makehuman_derived");
        if (!folder) QSKIP("the heads are not here");
        const auto coarse = load(*folder / "head_neutral.obj");
        const auto fine = load(*folder / "head_neutral_sub1.glb");
        QVERIFY(coarse.ok() && fine.ok());
        QCOMPARE(fine->mesh.triangleCount(), coarse->mesh.triangleCount() * 4);
        const Bounds a = boundsOf(coarse->mesh), b = boundsOf(fine->mesh);
        QVERIFY(glm::length(a.centre() - b.centre()) < 0.02f * glm::length(a.size()));
        // UVs too: glTF's v was turned, so the same places have the same UVs. Compare their bounds.
        const auto uvBounds = [](const SurfaceMesh& mesh) {
            glm::vec2 low(1e9f), high(-1e9f);
            for (const glm::vec2& uv : mesh.cornerUvs) {
                low = glm::min(low, uv);
                high = glm::max(high, uv);
            }
            return std::pair(low, high);
        };
        QVERIFY(glm::length(uvBounds(coarse->mesh).first - uvBounds(fine->mesh).first) < 0.02f);
        QVERIFY(glm::length(uvBounds(coarse->mesh).second - uvBounds(fine->mesh).second) < 0.02f);
    }

    void texturesOfRealFiles() {
        const auto file = testing::realData("animals/crane/bob/bob_tri.obj");
        if (!file) QSKIP("the animals are not here");
        Progress progress;
        const auto got = importMesh(*file, progress);
        QVERIFY(got.ok());
        for (const MeshPart& part : got->mesh.parts) {
            QVERIFY(part.texture.empty() || got->textures.find(part.texture) != nullptr);
        }
    }

private:
    void everyFileLoadsOrIsRefused_rows() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"heads", "animals", "stanford"}) QTest::newRow(name) << name;
    }
};

QTEST_APPLESS_MAIN(MeshCorpusTest)
#include "mesh_corpus_test.moc"
