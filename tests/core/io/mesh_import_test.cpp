// SPDX-License-Identifier: Apache-2.0
// Laws of every importer on files that are made here.
#include "core/io/mesh_import.h"

#include "core/io/image.h"
#include "core/surface/surface_point.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>
#include <sys/stat.h>

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

using namespace whorl;
using testing::GltfBuilder;
namespace fs = std::filesystem;

namespace {

Result<ImportedMesh> fromText(const std::string& text, const std::string& format) {
    Progress progress;
    return importMeshBytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, format, progress);
}

Result<ImportedMesh> fromGlb(const GltfBuilder& builder) {
    Progress progress;
    return importMeshBytes(builder.glb(), "glb", progress);
}

void put(const fs::path& file, const void* data, std::size_t bytes) {
    std::ofstream(file, std::ios::binary).write(static_cast<const char*>(data), std::streamsize(bytes));
}

bool goodSentence(const std::string& text) {
    return text.size() > 10 && text.back() == '.' && text.find('\n') == std::string::npos;
}

// What SurfaceMesh promises; empty when all holds.
std::string brokenPromise(const SurfaceMesh& mesh) {
    if (mesh.triangles.empty()) return "no triangles";
    if (mesh.normals.size() != mesh.positions.size()) return "normals";
    if (mesh.cornerUvs.size() != mesh.triangles.size() * 3) return "UVs";
    std::uint32_t next = 0;
    for (const MeshPart& part : mesh.parts) {
        if (part.firstTriangle != next || part.triangleCount == 0) return "parts are not contiguous";
        if (part.name.empty()) return "a part without a name";
        next += part.triangleCount;
    }
    if (next != mesh.triangleCount()) return "parts do not cover";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return "a position is not finite";
        if (!(std::abs(glm::length(mesh.normals[i]) - 1.0f) < 1e-3f)) return "a normal is not of unit length";
    }
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        for (int k = 0; k < 3; ++k) {
            if (mesh.triangles[t][k] >= mesh.positions.size()) return "an index is out of range";
        }
        if (!(triangleArea(mesh, t) > 0.0)) return "a triangle has no area";
    }
    for (const glm::vec2& uv : mesh.cornerUvs) {
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a UV is not finite";
    }
    return {};
}

double area(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) sum += triangleArea(mesh, t);
    return sum;
}

// Above zero when the triangles of a closed mesh face outwards.
double volume(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                        glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
    }
    return sum / 6.0;
}

// Corner positions of all triangles in an order that does not depend on the file's.
std::vector<std::array<float, 9>> soup(const SurfaceMesh& mesh) {
    std::vector<std::array<float, 9>> out;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<std::array<float, 3>, 3> corners;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions[t[k]];
            corners[std::size_t(k)] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::array<float, 9> flat;
        for (std::size_t k = 0; k < 9; ++k) flat[k] = corners[k / 3][k % 3];
        out.push_back(flat);
    }
    std::sort(out.begin(), out.end());
    return out;
}

// A tetrahedron that faces outwards.
const std::vector<float> tetraPositions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint16_t> tetraIndices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
const std::vector<float> tetraUvs{0, 0, 1, 0, 0, 1, 1, 1};
const std::string tetraObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

GltfBuilder tetra() {
    GltfBuilder builder;
    const int positions = builder.addFloats(tetraPositions, "VEC3", 3);
    const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
    builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return builder;
}

SurfaceMesh expectedTetra() {
    return fromText(tetraObj, "obj")->mesh;
}

template <class T>
void appendBytes(std::string& out, T value, bool big) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
}

std::string tetraPly(const std::string& encoding) {
    std::string out =
        "ply\nformat " + encoding + " 1.0\ncomment made here\nelement vertex 4\nproperty uchar red\n" +
        "property double y\nproperty float x\nproperty float z\nelement junk 2\nproperty list uchar short "
        "numbers\nelement face 4\nproperty int flag\nproperty list uchar int vertex_indices\nend_header\n";
    const bool big = encoding == "binary_big_endian";
    for (std::size_t i = 0; i < 4; ++i) {
        const float* p = &tetraPositions[i * 3];
        if (encoding == "ascii") {
            out += "7 " + std::to_string(p[1]) + " " + std::to_string(p[0]) + " " + std::to_string(p[2]) + "\n";
            continue;
        }
        appendBytes<std::uint8_t>(out, 7, big);
        appendBytes<double>(out, double(p[1]), big);
        appendBytes<float>(out, p[0], big);
        appendBytes<float>(out, p[2], big);
    }
    if (encoding == "ascii") {
        out += "0\n3 1 2 3\n";
    } else {
        appendBytes<std::uint8_t>(out, 0, big);
        appendBytes<std::uint8_t>(out, 2, big);
        appendBytes<std::int16_t>(out, 5, big);
        appendBytes<std::int16_t>(out, 6, big);
    }
    for (std::size_t f = 0; f < 4; ++f) {
        if (encoding == "ascii") {
            out += "-1 3";
            for (std::size_t k = 0; k < 3; ++k) out += " " + std::to_string(tetraIndices[f * 3 + k]);
            out += "\n";
            continue;
        }
        appendBytes<std::int32_t>(out, -1, big);
        appendBytes<std::uint8_t>(out, 3, big);
        for (std::size_t k = 0; k < 3; ++k) appendBytes<std::int32_t>(out, tetraIndices[f * 3 + k], big);
    }
    return out;
}

}  // namespace

class MeshImportTest : public QObject {
    Q_OBJECT

    // The tetrahedron, whatever file it came in.
    void isTetra(const Result<ImportedMesh>& got) {
        QVERIFY2(got.ok(), got ? "" : got.error().message.c_str());
        QCOMPARE(brokenPromise(got->mesh), std::string());
        QCOMPARE(got->mesh.positions.size(), std::size_t{4});
        QCOMPARE(got->sourceTriangles, 4u);
        QVERIFY(volume(got->mesh) > 0.0);
        QVERIFY(soup(got->mesh) == soup(expectedTetra()));
    }

private Q_SLOTS:
    void sameSurfaceFromEveryFormat() {
        isTetra(fromText(tetraObj, "obj"));
        isTetra(fromText(tetraPly("ascii"), "ply"));
        isTetra(fromText(tetraPly("binary_little_endian"), "ply"));
        isTetra(fromText(tetraPly("binary_big_endian"), "ply"));
        isTetra(fromGlb(tetra()));
    }

    void objDialects() {
        isTetra(
            fromText("# c\r\nv\t0 0 0\r\nv 1 0 \\\r\n0\r\nv +0 1.0e0 0 # one\r\nv 0 0 1 0.5 0.5 0.5\r\n"
                     "f 1//  3// 2//\r\nf -4 -3 -1\r\nf 1 4 3\r\nf 2/ 3/ 4/",
                     "obj"));
        isTetra(fromText("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n", "obj"));
    }

    void gltfIndices_data() {
        QTest::addColumn<int>("type");
        QTest::newRow("8 bit") << 5121;
        QTest::newRow("16 bit") << 5123;
        QTest::newRow("32 bit") << 5125;
        QTest::newRow("none") << 0;
    }
    void gltfIndices() {
        QFETCH(int, type);
        GltfBuilder builder;
        nlohmann::json primitive;
        if (type == 0) {
            std::vector<float> all;
            for (const std::uint16_t i : tetraIndices) {
                all.insert(all.end(), tetraPositions.begin() + i * 3, tetraPositions.begin() + i * 3 + 3);
            }
            primitive["attributes"]["POSITION"] = builder.addFloats(all, "VEC3", 3);
        } else {
            primitive["attributes"]["POSITION"] = builder.addFloats(tetraPositions, "VEC3", 3);
            const int view =
                type == 5121   ? builder.addView(std::vector<std::uint8_t>(tetraIndices.begin(), tetraIndices.end()))
                : type == 5123 ? builder.addView(tetraIndices)
                               : builder.addView(std::vector<std::uint32_t>(tetraIndices.begin(), tetraIndices.end()));
            primitive["indices"] = builder.addAccessor(view, type, "SCALAR", 12);
        }
        builder.show(primitive);
        isTetra(fromGlb(builder));
    }

    void gltfInterleavedSparseAndQuantised() {
        {
            GltfBuilder builder;  // position and something else in turn
            std::vector<float> mixed;
            for (std::size_t i = 0; i < 4; ++i) {
                mixed.insert(mixed.end(),
                             {9.0f, tetraPositions[i * 3], tetraPositions[i * 3 + 1], tetraPositions[i * 3 + 2]});
            }
            const int positions = builder.addAccessor(builder.addView(mixed, 16), 5126, "VEC3", 4, 4);
            const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
            builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
            isTetra(fromGlb(builder));
        }
        {
            GltfBuilder builder;  // three corners replaced in an accessor of zeros
            const int positions = builder.addAccessor(-1, 5126, "VEC3", 4);
            const int which = builder.addView(std::vector<std::uint8_t>{1, 2, 3});
            const int values = builder.addView(std::vector<float>(tetraPositions.begin() + 3, tetraPositions.end()));
            builder.json["accessors"][std::size_t(positions)]["sparse"] = {
                {"count", 3},
                {"indices", {{"bufferView", which}, {"componentType", 5121}}},
                {"values", {{"bufferView", values}}}};
            const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
            builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
            isTetra(fromGlb(builder));
        }
        for (const bool wide : {false, true}) {
            GltfBuilder builder;  // normalised integers, padded to four bytes
            int view = 0;
            if (wide) {
                std::vector<std::uint16_t> values;
                for (const float p : tetraPositions) {
                    values.push_back(p > 0.5f ? 65535 : 0);
                    if (values.size() % 4 == 3) values.push_back(0);
                }
                view = builder.addView(values, 8);
            } else {
                std::vector<std::int8_t> values;
                for (const float p : tetraPositions) {
                    values.push_back(p > 0.5f ? 127 : 0);
                    if (values.size() % 4 == 3) values.push_back(0);
                }
                view = builder.addView(values, 4);
            }
            const int positions = builder.addAccessor(view, wide ? 5123 : 5120, "VEC3", 4, 0, true);
            const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
            builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
            builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
            isTetra(fromGlb(builder));
        }
    }

    void gltfStripsAndFans() {
        for (const int mode : {5, 6}) {
            GltfBuilder builder;
            const std::vector<float> corners = mode == 5
                                                   ? std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}
                                                   : std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
            builder.show({{"attributes", {{"POSITION", builder.addFloats(corners, "VEC3", 3)}}}, {"mode", mode}});
            const auto got = fromGlb(builder);
            QVERIFY(got.ok());
            QCOMPARE(got->mesh.triangleCount(), 3u);
            QCOMPARE(area(got->mesh), 1.5);
            for (std::uint32_t t = 0; t < 3; ++t) QVERIFY(triangleNormal(got->mesh, t).z > 0.99f);
        }
    }

    void pointsAndLinesAreSkipped() {
        GltfBuilder builder = tetra();
        builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
        const auto got = fromGlb(builder);
        isTetra(got);
        QCOMPARE(got->problems.size(), std::size_t{2});  // and the atlas
        GltfBuilder onlyPoints;
        onlyPoints.show({{"attributes", {{"POSITION", onlyPoints.addFloats(tetraPositions, "VEC3", 3)}}}, {"mode", 1}});
        QVERIFY(!fromGlb(onlyPoints).ok());
    }

    void nodesMoveTurnAndMirror() {
        GltfBuilder builder = tetra();
        builder.json["nodes"] = nlohmann::json::array(
            {{{"children", {1, 2}}, {"translation", {10, 0, 0}}},
             {{"mesh", 0}, {"scale", {2, 2, 2}}, {"name", "big"}},
             {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1}}, {"name", "mirrored"}}});
        const auto got = fromGlb(builder);
        QVERIFY2(got.ok(), got ? "" : got.error().message.c_str());
        QCOMPARE(brokenPromise(got->mesh), std::string());
        QCOMPARE(got->mesh.parts.size(), std::size_t{2});
        QCOMPARE(got->mesh.parts[0].name, std::string("big"));
        QCOMPARE(got->sourceTriangles, 4u);  // one mesh, two instances
        QCOMPARE(got->mesh.triangleCount(), 8u);
        QVERIFY(std::abs(volume(got->mesh) - 9.0 / 6.0) < 1e-5);
        const Bounds bounds = boundsOf(got->mesh);
        QCOMPARE(bounds.min.x, 9.0f);
        QCOMPARE(bounds.max.x, 12.0f);
        QCOMPARE(bounds.max.y, 6.0f);
    }

    void rotationTurnsTheRightWay() {
        GltfBuilder builder = tetra();
        const double half = std::sqrt(0.5);
        builder.json["nodes"][0]["rotation"] = {0, 0, half, half};  // x to y
        const auto got = fromGlb(builder);
        QVERIFY(got.ok());
        const Bounds bounds = boundsOf(got->mesh);
        QVERIFY(std::abs(bounds.min.x + 1.0f) < 1e-6f && std::abs(bounds.max.x) < 1e-6f);
    }

    void withoutScenesOrNodes() {
        GltfBuilder builder = tetra();
        builder.json.erase("scene");
        builder.json.erase("scenes");
        isTetra(fromGlb(builder));
        builder.json.erase("nodes");
        isTetra(fromGlb(builder));
    }

    void uvsPointUpAndFollowTheTexture() {
        GltfBuilder builder;
        const int positions = builder.addFloats(tetraPositions, "VEC3", 3);
        const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
        const int first = builder.addFloats(std::vector<float>(8, 0.25f), "VEC2", 2);
        const int second = builder.addFloats(tetraUvs, "VEC2", 2);
        builder.add(
            "materials",
            {{"pbrMetallicRoughness",
              {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}, {"baseColorFactor", {0.5, 0.25, 1.0, 1.0}}}}});
        builder.show({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
                      {"indices", indices},
                      {"material", 0}});
        const auto got = fromGlb(builder);
        QVERIFY2(got.ok(), got ? "" : got.error().message.c_str());
        QVERIFY(!got->mesh.madeAtlas);
        QCOMPARE(got->mesh.parts[0].baseColour.y, 0.25f);
        // Corner 3 of the tetrahedron has glTF's (1, 1), the lower right of the image: v = 0 in Whorl.
        for (std::size_t i = 0; i < 12; ++i) {
            const glm::vec3 p = got->mesh.positions[got->mesh.triangles[i / 3][int(i % 3)]];
            if (p.z == 1.0f) QVERIFY(got->mesh.cornerUvs[i] == glm::vec2(1.0f, 0.0f));
            if (p.x == 1.0f) QVERIFY(got->mesh.cornerUvs[i] == glm::vec2(1.0f, 1.0f));
        }
    }

    void texturesComeAlong() {
        const fs::path folder = testing::scratchFolder("mesh_import_textures");
        const std::uint8_t pixels[] = {255, 0, 0, 0, 255, 0};
        QVERIFY(writePixels(pixels, 2, 1, 3, folder / "skin.png").ok());
        std::ifstream in(folder / "skin.png", std::ios::binary);
        const std::vector<std::uint8_t> png{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};

        GltfBuilder builder;
        const int positions = builder.addFloats(tetraPositions, "VEC3", 3);
        const int uvs = builder.addFloats(tetraUvs, "VEC2", 2);
        const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
        builder.add("images", {{"bufferView", builder.addView(png)}, {"mimeType", "image/png"}, {"name", "pelt"}});
        builder.add("textures", {{"source", 0}});
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        builder.show(
            {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"indices", indices}, {"material", 0}});
        const auto got = fromGlb(builder);
        QVERIFY(got.ok());
        QCOMPARE(got->mesh.parts[0].texture, std::string("pelt"));
        const Map* map = got->textures.find("pelt");
        QVERIFY(map != nullptr && map->width() == 2 && map->channels() == 3 && map->srgb);
        QCOMPARE(map->texel(0, 0, 0), 1.0f);

        builder.json["images"][0] = {{"uri", "skin.png"}};
        const std::string text = builder.gltf("mesh.bin");
        put(folder / "mesh.gltf", text.data(), text.size());
        put(folder / "mesh.bin", builder.bytes.data(), builder.bytes.size());
        Progress progress;
        const auto fromFile = importMesh(folder / "mesh.gltf", progress);
        QVERIFY2(fromFile.ok(), fromFile ? "" : fromFile.error().message.c_str());
        QCOMPARE(fromFile->mesh.parts[0].texture, std::string("skin"));
        QVERIFY(fromFile->textures.find("skin") != nullptr);
        QVERIFY(importMesh(folder / "mesh.gltf", progress, {.textures = false})->textures.entries().empty());

        const std::string obj =
            "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\n" + tetraObj.substr(0, 32) + "f 1/1 3/2 2/3\n";
        const std::string mtl = "newmtl red\nKd 0.5 0 0\nmap_Kd -s 1 1 1 skin.png\n";
        put(folder / "a.obj", obj.data(), obj.size());
        put(folder / "a.mtl", mtl.data(), mtl.size());
        const auto fromObj = importMesh(folder / "a.obj", progress);
        QVERIFY2(fromObj.ok(), fromObj ? "" : fromObj.error().message.c_str());
        QCOMPARE(fromObj->mesh.parts[0].texture, std::string("skin"));
        QVERIFY(fromObj->textures.find("skin") != nullptr);
    }

    void badTexturesCostOnlyThemselves() {
        GltfBuilder builder;
        const int positions = builder.addFloats(tetraPositions, "VEC3", 3);
        const int uvs = builder.addFloats(tetraUvs, "VEC2", 2);
        const int indices = builder.addAccessor(builder.addView(tetraIndices), 5123, "SCALAR", 12);
        builder.add("images", {{"uri", "data:image/png;base64,!!!!"}});
        builder.add("images", {{"name", "nothing at all"}});
        builder.add("textures", {{"source", 0}});
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        builder.show(
            {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"indices", indices}, {"material", 0}});
        const auto got = fromGlb(builder);
        isTetra(got);
        QVERIFY(got->mesh.parts[0].texture.empty());
        QVERIFY(!got->problems.empty());
    }

    void polygonsKeepTheirArea_data() {
        QTest::addColumn<int>("sides");
        QTest::newRow("concave quad") << 4;
        QTest::newRow("star of 10") << 10;
        QTest::newRow("star of 400") << 400;
        QTest::newRow("star of 4,096") << 4096;
    }
    void polygonsKeepTheirArea() {
        QFETCH(int, sides);
        std::string obj;
        std::string face = "f";
        double expected = 0.0;
        std::vector<glm::dvec2> corners;
        for (int i = 0; i < sides; ++i) {
            const double angle = 2.0 * M_PI * i / sides;
            const double radius = i % 2 == 0 ? 1.0 : sides == 4 && i == 1 ? 0.1 : 0.7;
            corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            obj += "v " + std::to_string(corners.back().x) + " " + std::to_string(corners.back().y) + " 0.5\n";
            face += " " + std::to_string(i + 1);
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& a = corners[i];
            const auto& b = corners[(i + 1) % corners.size()];
            expected += 0.5 * (a.x * b.y - a.y * b.x);
        }
        const auto got = fromText(obj + face + "\n", "obj");
        QVERIFY(got.ok());
        QCOMPARE(got->sourceTriangles, std::uint32_t(sides - 2));
        QVERIFY2(std::abs(area(got->mesh) - expected) < 1e-4, qPrintable(QString::number(area(got->mesh) - expected)));
        for (std::uint32_t t = 0; t < got->mesh.triangleCount(); ++t) QVERIFY(triangleNormal(got->mesh, t).z > 0.0f);
    }

    void objPartsAreContiguous() {
        const auto got = fromText(
            tetraObj.substr(0, 32) + "g skin\nf 1 3 2\ng hair\nf 1 2 4\ng skin\nf 1 4 3\nusemtl red\nf 2 3 4\n", "obj");
        QVERIFY(got.ok());
        QCOMPARE(brokenPromise(got->mesh), std::string());
        QCOMPARE(got->mesh.parts.size(), std::size_t{3});
        QCOMPARE(got->mesh.parts[0].name, std::string("skin"));
        QCOMPARE(got->mesh.parts[0].triangleCount, 2u);
        QCOMPARE(got->mesh.parts[1].name, std::string("hair"));
        QCOMPARE(got->mesh.parts[2].name, std::string("skin / red"));
    }

    void repairsAreCounted() {
        const auto got =
            fromText(tetraObj + "v nan 0 0\nv 1e39 0 0\nf 1 2 5\nf 1 2 6\nf 1 1 2\nf 3 3 3\nf 1 2\n", "obj");
        QVERIFY(got.ok());
        QCOMPARE(brokenPromise(got->mesh), std::string());
        QCOMPARE(got->mesh.triangleCount(), 4u);
        QCOMPARE(got->sourceTriangles, 8u);
        QCOMPARE(got->problems.size(), std::size_t{4});
        for (const std::string& problem : got->problems) QVERIFY2(goodSentence(problem), problem.c_str());
    }

    void weldKeepsSeamsOfUvsOnly() {
        // Two triangles of a square that share no vertex in the file.
        const auto got = fromText(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 -0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.4 0\nvt 0.4 1\nvt 0.6 0\n"
            "vt 1 1\nvt 0.6 1\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n",
            "obj");
        QVERIFY(got.ok());
        QCOMPARE(got->mesh.positions.size(), std::size_t{4});
        QCOMPARE(got->mesh.cornerUvs[0].x, 0.0f);
        QCOMPARE(got->mesh.cornerUvs[3].x, 0.6f);
    }

    void wildUnitsAreScaled() {
        for (const char* unit : {"1e25", "1e-25"}) {
            const std::string u(unit);
            const std::string obj =
                "v 0 0 0\nv " + u + " 0 0\nv 0 " + u + " 0\nv 0 0 " + u + "\n" + tetraObj.substr(32);
            const auto got = fromText(obj, "obj");
            QVERIFY2(got.ok(), got ? "" : got.error().message.c_str());
            QCOMPARE(got->mesh.triangleCount(), 4u);
            QVERIFY(volume(got->mesh) > 1e-3 && volume(got->mesh) < 1e3);
        }
    }

    void refused_data() {
        QTest::addColumn<QString>("format");
        QTest::addColumn<QByteArray>("bytes");
        const auto row = [](const char* name, const char* format, const std::string& bytes) {
            QTest::newRow(name) << format << QByteArray(bytes.data(), qsizetype(bytes.size()));
        };
        row("empty obj", "obj", "");
        row("obj without faces", "obj", "v 0 0 0\nv 1 0 0\n");
        row("obj index 0", "obj", tetraObj + "f 0 1 2\n");
        row("obj index past the end", "obj", tetraObj + "f 1 2 5\n");
        row("obj index far past the end", "obj", tetraObj + "f 1 2 99999999999999999999\n");
        row("obj negative index past the start", "obj", tetraObj + "f -5 1 2\n");
        row("obj decimal comma", "obj", "v 0,5 0 0\n" + tetraObj);
        row("obj vertex of two numbers", "obj", "v 0 0\n" + tetraObj);
        row("obj word for a number", "obj", "v 0 0 zero\n" + tetraObj);
        row("ply without end", "ply", "ply\nformat ascii 1.0\n");
        row("ply of an unknown type", "ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n");
        row("ply without positions", "ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n");
        row("ply negative count", "ply", "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n");
        row("ply claims too much", "ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n"
            "property float y\nproperty float z\nend_header\nabc");
        row("ply cut off", "ply",
            tetraPly("binary_little_endian").substr(0, tetraPly("binary_little_endian").size() - 3));
        row("gltf no JSON", "gltf", "hello");
        row("gltf deep JSON", "gltf", "{\"a\":" + std::string(100000, '[') + std::string(100000, ']') + "}");
        row("gltf cut JSON", "gltf", "{\"asset\":{\"version\":\"2.0\"");
        row("glb of 12 bytes", "glb", std::string("glTF\2\0\0\0\x0c\0\0\0", 12));
        row("format that is none", "stl", "solid");
    }
    void refused() {
        QFETCH(QString, format);
        QFETCH(QByteArray, bytes);
        const auto got = fromText(bytes.toStdString(), format.toStdString());
        QVERIFY(!got.ok());
        QVERIFY2(goodSentence(got.error().message), got.error().message.c_str());
    }

    void gltfAccessorsAreChecked_data() {
        QTest::addColumn<int>("fault");
        for (int i = 0; i < 16; ++i) QTest::newRow(qPrintable(QString("fault %1").arg(i))) << i;
    }
    void gltfAccessorsAreChecked() {
        QFETCH(int, fault);
        GltfBuilder builder = tetra();
        auto& position = builder.json["accessors"][0];
        auto& index = builder.json["accessors"][1];
        auto& view = builder.json["bufferViews"][0];
        switch (fault) {
            case 0:
                position["count"] = 5;
                break;
            case 1:
                position["count"] = 18446744073709551615ull;
                break;
            case 2:
                position["byteOffset"] = 4;
                break;
            case 3:
                position["byteOffset"] = 18446744073709551608ull;
                break;
            case 4:
                position["componentType"] = 5124;
                break;
            case 5:
                position["type"] = "VEC2";
                break;
            case 6:
                position["bufferView"] = 7;
                break;
            case 7:
                view["byteLength"] = 1ull << 40;
                break;
            case 8:
                view["byteOffset"] = 1ull << 62;
                break;
            case 9:
                view["byteStride"] = 8;
                break;
            case 10:
                view["buffer"] = 3;
                break;
            case 11:
                index["count"] = 13;
                break;
            case 12:
                index["componentType"] = 5126;
                break;
            case 13:
                builder.json["meshes"][0]["primitives"][0]["indices"] = 9;
                break;
            case 14:
                builder.bytes[builder.bytes.size() - 2] = 200;
                break;  // index of a vertex that is not there
            case 15:
                builder.json["nodes"][0]["children"] = {0};
                break;
        }
        const auto got = fromGlb(builder);
        QVERIFY(!got.ok());
        QVERIFY2(goodSentence(got.error().message), got.error().message.c_str());
    }

    void unknownRequiredExtensionsAreNamed() {
        for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_unheard_of"}) {
            GltfBuilder builder = tetra();
            builder.json["extensionsRequired"] = {extension};
            const auto got = fromGlb(builder);
            QVERIFY(!got.ok());
            QVERIFY2(got.error().message.find(extension) != std::string::npos, got.error().message.c_str());
        }
    }

    void instancesCanNotExplode() {
        GltfBuilder builder;
        const int positions = builder.addAccessor(-1, 5126, "VEC3", 300000);
        const int which = builder.addView(std::vector<std::uint8_t>{1});
        const int values = builder.addView(std::vector<float>{1, 2, 3});
        builder.json["accessors"][std::size_t(positions)]["sparse"] = {
            {"count", 1},
            {"indices", {{"bufferView", which}, {"componentType", 5121}}},
            {"values", {{"bufferView", values}}}};
        builder.show({{"attributes", {{"POSITION", positions}}}});
        builder.json.erase("scenes");
        builder.json.erase("scene");
        for (int i = 0; i < 1000; ++i) builder.add("nodes", {{"mesh", 0}});
        QElapsedTimer timer;
        timer.start();
        const auto got = fromGlb(builder);
        QVERIFY(!got.ok());
        QVERIFY2(got.error().message.find("20 million") != std::string::npos, got.error().message.c_str());
        QVERIFY(timer.elapsed() < 5000);
    }

    void nothingOutsideTheFolderIsRead() {
        const fs::path outer = testing::scratchFolder("mesh_import_outer");
        const fs::path folder = outer / "inner";
        fs::create_directories(folder / "sub");
        const GltfBuilder builder = tetra();
        for (const fs::path& file : {outer / "secret.bin", folder / "mesh.bin", folder / "sub" / "mesh.bin"}) {
            put(file, builder.bytes.data(), builder.bytes.size());
        }
        fs::create_symlink(outer / "secret.bin", folder / "link.bin");
        fs::create_symlink("mesh.bin", folder / "inside.bin");
        fs::create_directory_symlink(outer, folder / "up");
        QCOMPARE(mkfifo((folder / "pipe.bin").c_str(), 0600), 0);
        Progress progress;
        const auto load = [&](const std::string& uri) {
            const std::string text = builder.gltf(uri);
            put(folder / "mesh.gltf", text.data(), text.size());
            return importMesh(folder / "mesh.gltf", progress);
        };
        for (const std::string uri : {"mesh.bin", "sub/mesh.bin", "sub/../mesh.bin", "mesh%2Ebin", "inside.bin"})
            isTetra(load(uri));
        const std::string absolute = (outer / "secret.bin").string();
        for (const std::string& uri :
             {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), absolute, "file://" + absolute,
              std::string("link.bin"), std::string("up/secret.bin"), std::string("pipe.bin"), std::string("sub"),
              std::string("."), std::string(), std::string("http://127.0.0.1:9/x.bin"), std::string("/dev/zero"),
              std::string("..\\secret.bin"), std::string(70000, 'a')}) {
            const auto got = load(uri);
            QVERIFY2(!got.ok(), uri.substr(0, 60).c_str());
            QVERIFY2(goodSentence(got.error().message), got.error().message.c_str());
        }
        const std::string obj = "mtllib ../secret.bin\nmtllib /etc/passwd\n" + tetraObj;
        put(folder / "mesh.obj", obj.data(), obj.size());
        const auto got = importMesh(folder / "mesh.obj", progress);
        isTetra(got);
        QCOMPARE(got->problems.size(), std::size_t{3});
        QVERIFY(!importMesh(folder / "pipe.bin", progress).ok());
        QVERIFY(!importMesh(folder, progress).ok());
    }

    // Files in tests/data/mesh_import on which an importer once failed; to be run under sanitizers too.
    void onceFailed() {
        const QByteArray resources = qgetenv("WHORL_RESOURCES");
        if (resources.isEmpty()) QSKIP("WHORL_RESOURCES does not name the resources of the tree");
        const fs::path folder = fs::path(resources.toStdString()) / ".." / "tests" / "data" / "mesh_import";
        int files = 0;
        for (const auto& entry : fs::directory_iterator(folder)) {
            Progress progress;
            const auto got = importMesh(entry.path(), progress, {.textures = false});
            if (got) QCOMPARE(brokenPromise(got->mesh), std::string());
            if (!got) QVERIFY2(goodSentence(got.error().message), got.error().message.c_str());
            ++files;
        }
        QVERIFY(files > 0);
    }

    void cancelled() {
        Progress progress;
        progress.cancel();
        const auto got = importMeshBytes(tetra().glb(), "glb", progress);
        QVERIFY(!got.ok() && got.error().cancelled);
    }
};

QTEST_APPLESS_MAIN(MeshImportTest)
#include "mesh_import_test.moc"
