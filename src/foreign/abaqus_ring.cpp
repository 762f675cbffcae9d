#include "foreign/abaqus_ring.hpp"

#include "base/names.hpp"

namespace dygita {

AbaqusRing ring_of(const CardFile& file, const FileCard& tie) {
  for (const FileCard& card : file.cards()) {
    if (card.keyword != "CYCLICSYMMETRYMODEL") continue;
    if (card.has("TIE") && in_capitals(card.option("TIE")) != in_capitals(tie.option("NAME"))) continue;
    if (card.data.empty()) file.fail(card, "it has no axis");
    const std::string sectors = card.option("N");  // a line of data has no text of its own
    const DataLine of_n{sectors, card.file, card.line};
    LineFields fields(file, card.data[0]);
    const auto point = [&] {
      const double x = fields.real("a coordinate"), y = fields.real("a coordinate"), z = fields.real("a coordinate");
      return Vec3(x, y, z);
    };
    const long n = LineFields(file, of_n).whole("N = sectors of the ring");
    const Vec3 from = point(), to = point();
    if (n < 2 || from == to) file.fail(card, "an axis through two points, and two sectors or more, are expected");
    return {n, from, to};
  }
  file.fail(tie, "there is no *CYCLIC SYMMETRY MODEL of it");
}

}  // namespace dygita
