#include "bad_input.h"

namespace peregrine::test {
namespace {

//   3 -- 2
//   |  / |    two triangles, indices 0 1 2, 0 2 3
//   0 -- 1
struct Quad {
    std::vector<float> positions = {0, 9, 0, 1, 9, 0, 1, 9, 1, 0, 9, 1};
    std::vector<float> four = std::vector<float>(16, 0.5f); // of any vertex attribute
    std::vector<uint32_t> indices = {0, 1, 2, 0, 2, 3};
    std::vector<uint16_t> short_indices = {0, 1, 2, 0, 2, 3};
    std::vector<rt_material> materials;

    rt_mesh_desc desc() const {
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = array_of(positions, 4);
        desc.indices = array_of(indices, 6);
        return desc;
    }
};

class BadMesh : public BadInput {
protected:
    void refuse(const rt_mesh_desc& desc, rt_result expected, const std::string& words) {
        for (const auto add : {rt_add_static_mesh, rt_add_dynamic_mesh}) {
            auto mesh = kUntouched<rt_mesh>;
            expect_refused(add(scene(), &desc, &mesh), expected, words);
            EXPECT_TRUE(untouched(mesh));
        }
    }

    // Each way in which a vertex array can be wrong.
    void refuse_array(rt_array rt_mesh_desc::*member, uint32_t element, const std::string& name) {
        const std::string field = "rt_mesh_desc." + name;
        const rt_array good = {quad_.four.data(), 4, 0, 0};
        const auto with = [&](rt_array array) {
            rt_mesh_desc desc = quad_.desc();
            desc.*member = array;
            return desc;
        };
        refuse(with({nullptr, 4, 0, 0}), RT_ERROR_INVALID_ARGUMENT, field + ".data is null");
        refuse(with({good.data, 4, element - 1, 0}), RT_ERROR_INVALID_ARGUMENT, field + ".stride");
        refuse(with({good.data, 4, 1, 0}), RT_ERROR_INVALID_ARGUMENT, field + ".stride is 1");
        refuse(with({good.data, 4, 0, 1}), RT_ERROR_INVALID_ARGUMENT, field + ".reserved");
    }

    void refuse_attribute(rt_array rt_mesh_desc::*member, uint32_t element,
                          const std::string& name) {
        refuse_array(member, element, name);
        for (const uint64_t count : {uint64_t(3), uint64_t(5)}) {
            rt_mesh_desc desc = quad_.desc();
            desc.*member = {quad_.four.data(), count, 0, 0};
            refuse(desc, RT_ERROR_INVALID_ARGUMENT,
                   name + ".count is " + std::to_string(count) + ", but there are 4 vertices");
        }
        for (const uint64_t count : {uint64_t(1) << 63, ~uint64_t(0), uint64_t(1) << 32}) {
            rt_mesh_desc desc = quad_.desc();
            desc.*member = {quad_.four.data(), count, 0x80000000u, 0};
            auto mesh = kUntouched<rt_mesh>;
            EXPECT_NE(rt_add_static_mesh(scene(), &desc, &mesh), RT_OK);
            EXPECT_NE(std::string(rt_get_last_error()).find(name), std::string::npos);
            EXPECT_TRUE(untouched(mesh));
        }
    }

    Quad quad_;
};

TEST_F(BadMesh, NullOut) {
    const rt_mesh_desc desc = quad_.desc();
    expect_refused(rt_add_static_mesh(scene(), &desc, nullptr), RT_ERROR_INVALID_ARGUMENT,
                   "out_mesh is null");
}

TEST_F(BadMesh, Attributes) {
    refuse_attribute(&rt_mesh_desc::normals, 12, "normals");
    refuse_attribute(&rt_mesh_desc::tangents, 16, "tangents");
    refuse_attribute(&rt_mesh_desc::texcoords, 8, "texcoords");
    refuse_attribute(&rt_mesh_desc::texcoords1, 8, "texcoords1");
}

TEST_F(BadMesh, Positions) {
    refuse_array(&rt_mesh_desc::positions, 12, "positions");
    rt_mesh_desc desc = quad_.desc();
    desc.positions = {};
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.positions is absent");
    desc.positions = {quad_.positions.data(), 0, 0, 0};
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.positions is absent");
    for (const uint64_t count : {(uint64_t(1) << 30) + 1, uint64_t(1) << 63, ~uint64_t(0)}) {
        desc.positions = {quad_.positions.data(), count, 0, 0};
        refuse(desc, RT_ERROR_LIMIT, "rt_mesh_desc.positions.count is " + std::to_string(count));
    }
    desc.positions = {quad_.positions.data(), uint64_t(1) << 30, 0xffffffffu, 0};
    desc.index_type = RT_INDEX_NONE; // contradicts the indices, which is found before any read
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.indices");
}

TEST_F(BadMesh, ArrayBeyondTheAddressSpace) {
    rt_mesh_desc desc = quad_.desc();
    desc.positions = {reinterpret_cast<const void*>(~uintptr_t(0) - 47), 5, 0, 0};
    refuse(desc, RT_ERROR_LIMIT, "rt_mesh_desc.positions");
    desc.positions = {reinterpret_cast<const void*>(~uintptr_t(0)), 1, 0, 0};
    refuse(desc, RT_ERROR_LIMIT, "rt_mesh_desc.positions");
}

TEST_F(BadMesh, Indices) {
    refuse_array(&rt_mesh_desc::indices, 4, "indices");
    rt_mesh_desc desc = quad_.desc();
    desc.indices = {};
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.indices is absent");
    for (const uint64_t count : {1u, 2u, 4u, 5u}) {
        desc.indices = array_of(quad_.indices, count);
        refuse(desc, RT_ERROR_INVALID_ARGUMENT,
               "rt_mesh_desc.indices.count is " + std::to_string(count));
    }
    for (const uint64_t count : {(uint64_t(3) << 27) + 3, uint64_t(1) << 63, ~uint64_t(0)}) {
        desc.indices = array_of(quad_.indices, count);
        refuse(desc, RT_ERROR_LIMIT, "rt_mesh_desc.indices.count is " + std::to_string(count));
    }
}

TEST_F(BadMesh, IndexOutOfRangeIsNamed) {
    for (size_t place = 0; place < 6; ++place)
        for (const uint32_t index : {4u, 5u, 65535u, 65536u, 0xffffffffu}) {
            Quad quad;
            quad.indices[place] = index;
            rt_mesh_desc desc = quad.desc();
            const std::string words = "rt_mesh_desc.indices[" + std::to_string(place) + "] is ";
            refuse(desc, RT_ERROR_INVALID_ARGUMENT,
                   words + std::to_string(index) + ", but there are 4 vertices");
            if (index > 65535) continue;
            quad.short_indices[place] = uint16_t(index);
            desc.index_type = RT_INDEX_UINT16;
            desc.indices = array_of(quad.short_indices, 6);
            refuse(desc, RT_ERROR_INVALID_ARGUMENT, words + std::to_string(index));
        }
}

TEST_F(BadMesh, NoIndices) {
    rt_mesh_desc desc = quad_.desc();
    desc.index_type = RT_INDEX_NONE;
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.indices is there");
    desc.indices = {};
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.positions.count is 4");
    for (const int32_t type : {-1, 3, 1000, -2147483647 - 1}) {
        desc.index_type = type;
        refuse(desc, RT_ERROR_INVALID_ARGUMENT,
               "rt_mesh_desc.index_type is " + std::to_string(type));
    }
    desc = quad_.desc();
    desc.reserved = 5;
    refuse(desc, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_desc.reserved is 5");
}

TEST_F(BadMesh, Materials) {
    rt_mesh_desc desc = quad_.desc();
    desc.material = {55, 1};
    refuse(desc, RT_ERROR_INVALID_HANDLE, "rt_mesh_desc.material is {55, 1}");
    desc.material = {};
    quad_.materials = {world_->material, {56, 1}, {}};
    desc.materials = array_of(quad_.materials, 2);
    refuse(desc, RT_ERROR_INVALID_HANDLE, "rt_mesh_desc.materials[1] is {56, 1}");
    for (const uint64_t count : {uint64_t(1), uint64_t(3), uint64_t(1) << 40}) {
        desc.materials = array_of(quad_.materials, count);
        refuse(desc, RT_ERROR_INVALID_ARGUMENT,
               "rt_mesh_desc.materials.count is " + std::to_string(count)
                   + ", but there are 2 triangles");
    }
    refuse_array(&rt_mesh_desc::materials, 8, "materials");
}

TEST_F(BadMesh, Updates) {
    const auto refuse_update = [&](const rt_mesh_update& update, rt_result expected,
                                   const std::string& words) {
        expect_refused(rt_update_dynamic_mesh(scene(), world_->lift, &update), expected, words);
    };
    rt_mesh_update update = rt_default_mesh_update();
    update.reserved = 1;
    refuse_update(update, RT_ERROR_INVALID_ARGUMENT, "rt_mesh_update.reserved");
    for (const auto member :
         {&rt_mesh_update::positions, &rt_mesh_update::normals, &rt_mesh_update::tangents}) {
        update = rt_default_mesh_update();
        for (const uint64_t count : {uint64_t(3), uint64_t(5)}) {
            update.*member = {quad_.four.data(), count, 0, 0};
            refuse_update(update, RT_ERROR_INVALID_ARGUMENT, "but there are 4 vertices");
        }
        update.*member = {nullptr, 4, 0, 0};
        refuse_update(update, RT_ERROR_INVALID_ARGUMENT, ".data is null");
        update.*member = {quad_.four.data(), 4, 11, 0};
        refuse_update(update, RT_ERROR_INVALID_ARGUMENT, ".stride is 11");
        update.*member = {quad_.four.data(), 4, 0, 9};
        refuse_update(update, RT_ERROR_INVALID_ARGUMENT, ".reserved is 9");
    }
    update = rt_default_mesh_update();
    EXPECT_OK(rt_update_dynamic_mesh(scene(), world_->lift, &update)); // nothing to change
}

} // namespace
} // namespace peregrine::test
