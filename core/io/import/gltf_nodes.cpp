// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/gltf_scene.h"

#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace whorl::import {
namespace {

glm::dmat4 localTransform(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    glm::dmat4 rotation(1.0);
    if (node.rotation.size() == 4) {
        const auto& r = node.rotation;
        const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
        if (length > 0.0) {
            rotation = glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
        }
    }
    if (node.scale.size() == 3) {
        for (int i = 0; i < 3; ++i) matrix[i][i] = node.scale[static_cast<std::size_t>(i)];
    }
    matrix = rotation * matrix;
    if (node.translation.size() == 3) {
        for (int i = 0; i < 3; ++i) matrix[3][i] = node.translation[static_cast<std::size_t>(i)];
    }
    return matrix;
}

// Walks down from `roots`. A node that is met twice means a cycle or two parents: no tree.
Result<std::vector<GltfInstance>> walk(const tinygltf::Model& model, const std::vector<int>& roots) {
    struct Visit {
        int node;
        glm::dmat4 worldFromParent;
    };
    std::vector<GltfInstance> instances;
    std::vector<bool> met(model.nodes.size(), false);
    std::vector<Visit> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, glm::dmat4(1.0)});
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= model.nodes.size()) {
            return Error{"it names node " + std::to_string(visit.node) + " of " + std::to_string(model.nodes.size())};
        }
        const auto number = static_cast<std::size_t>(visit.node);
        if (met[number])
            return Error{"its nodes form no tree (node " + std::to_string(visit.node) +
                         " has two parents or is its own)"};
        met[number] = true;
        const tinygltf::Node& node = model.nodes[number];
        const glm::dmat4 world = visit.worldFromParent * localTransform(node);
        if (node.mesh >= 0) {
            if (static_cast<std::size_t>(node.mesh) >= model.meshes.size()) {
                return Error{"node " + std::to_string(visit.node) + " names mesh " + std::to_string(node.mesh) +
                             " of " + std::to_string(model.meshes.size())};
            }
            instances.push_back({node.mesh, visit.node, world});
        }
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            stack.push_back({*child, world});
    }
    return instances;
}

}  // namespace

Result<std::vector<GltfInstance>> findInstances(const tinygltf::Model& model) {
    if (!model.scenes.empty()) {
        const bool named =
            model.defaultScene >= 0 && static_cast<std::size_t>(model.defaultScene) < model.scenes.size();
        const auto& scene = model.scenes[named ? static_cast<std::size_t>(model.defaultScene) : 0];
        auto instances = walk(model, scene.nodes);
        if (!instances || !instances->empty()) return instances;
    }
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < isChild.size())
                isChild[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    }
    auto instances = walk(model, roots);
    if (!instances || !instances->empty()) return instances;
    for (std::size_t i = 0; i < model.meshes.size(); ++i)
        instances->push_back({static_cast<int>(i), -1, glm::dmat4(1.0)});
    return instances;
}

}  // namespace whorl::import
