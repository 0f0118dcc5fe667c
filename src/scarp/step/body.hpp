// Everything that a time step works on: the background mesh with its conditions, the fields of velocity on it, and what
// these do to each other.
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/boundary/conditions.hpp"
#include "scarp/mesh/locate.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/patches.hpp"
#include "scarp/step/interaction.hpp"
#include "scarp/step/velocity_field.hpp"

namespace scarp {

/// The blocks of some fields, one field after the other: a range of Block<Dim>, or of const ones of const fields.
template <class Field>
class BlocksOf {
  using Block = std::remove_reference_t<decltype((std::declval<Field&>().blocks[0]))>;
  using BlockRef = std::conditional_t<std::is_const_v<Field>, const std::remove_const_t<Block>, Block>;

 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Block;
    using difference_type = std::ptrdiff_t;
    using pointer = BlockRef*;
    using reference = BlockRef&;

    Iterator() = default;
    Iterator(Field* field, Field* end) : field_(field), end_(end) { skip_empty(); }
    BlockRef& operator*() const { return field_->blocks[at_]; }
    BlockRef* operator->() const { return &**this; }
    Iterator& operator++() {
      ++at_;
      skip_empty();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return field_ == other.field_ && at_ == other.at_; }

   private:
    void skip_empty() {
      while (field_ != end_ && at_ == field_->blocks.size()) {
        ++field_;
        at_ = 0;
      }
    }
    Field *field_ = nullptr, *end_ = nullptr;
    std::size_t at_ = 0;
  };

  BlocksOf(Field* first, Field* last) : first_(first), last_(last) {}
  Iterator begin() const { return {first_, last_}; }
  Iterator end() const { return {last_, last_}; }
  std::size_t size() const {
    std::size_t count = 0;
    for (Field* field = first_; field != last_; ++field) count += field->blocks.size();
    return count;
  }
  bool empty() const { return size() == 0; }
  /// Block b of all, which must be there.
  BlockRef& operator[](std::size_t b) const {
    Field* field = first_;
    for (; b >= field->blocks.size(); ++field) b -= field->blocks.size();
    return field->blocks[b];
  }

 private:
  Field *first_, *last_;
};

/// Soil on its background mesh. The mesh is held by pointer, so that it stays where the locator saw it.
template <int Dim>
struct Body {
  /// With one field, "soil", that has no blocks yet.
  Body(std::unique_ptr<const Mesh<Dim>> background, const Vec<Dim>& gravitational_acceleration);

  std::unique_ptr<const Mesh<Dim>> mesh;
  Patches patches;  ///< of its triangles or tetrahedra
  Column
      full_volume;  ///< of each node of a mesh with patches: Σ V_e / K_e over the elements e, of K_e nodes, around it
  Locator<Dim> locator;
  Conditions<Dim> conditions;
  Vec<Dim> gravity;
  std::vector<VelocityField<Dim>> fields;
  std::vector<std::unique_ptr<const Interaction<Dim>>> interactions;  ///< between fields, in this order

  /// One more field, without blocks. References to the others are no longer good.
  VelocityField<Dim>& add_field(std::string name);

  /// The blocks of all fields.
  BlocksOf<VelocityField<Dim>> blocks() { return {fields.data(), fields.data() + fields.size()}; }
  BlocksOf<const VelocityField<Dim>> blocks() const { return {fields.data(), fields.data() + fields.size()}; }
  int point_count() const;
};

/// Finds the element of every point anew and prepares the first step; displacements count from here. Throws InputError
/// where a point is outside the mesh. A point on a line between elements goes to the first of them, or with
/// `prefer_full` to that with the most points inside.
template <int Dim>
void locate_points(Body<Dim>& body, bool prefer_full = false);

/// Prepares the next step of points whose elements are known, with the arrays in the order of these: what
/// locate_points() ends with.
template <int Dim>
void take_up_points(Body<Dim>& body);

/// Orders points and buffers of all fields, or one, by element after points have moved or gone.
template <int Dim>
void reorder(Body<Dim>& body);
template <int Dim>
void reorder(const Body<Dim>& body, VelocityField<Dim>& field);

/// Room for the strain increments of a chunk, for each thread, and its books.
template <int Dim>
void prepare_threads(VelocityField<Dim>& field);

}  // namespace scarp
