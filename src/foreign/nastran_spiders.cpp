#include "foreign/nastran_spiders.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace dygita {

namespace {

bool is_real(std::string_view field) { return field.find('.') != std::string_view::npos; }

NastranSpider rigid(const NastranModel& model, const BulkCard& card, const BulkFields& fields) {
  NastranSpider spider{&card, false, model.node(fields.whole(2, "the number of a node"), fields), {}, fields.word(3),
                       "",    false};
  constexpr int first = 4;
  for (int i = first; i <= fields.size(); ++i)
    if (fields.has(i) && !is_real(fields.text(i)))  // the last may be an expansion by temperature
      spider.feet.push_back(model.node(fields.whole(i, "the number of a node"), fields));
  return spider;
}

// Weights, components and nodes in turns.
NastranSpider mean(const NastranModel& model, const BulkCard& card, const BulkFields& fields) {
  NastranSpider spider{&card, true, model.node(fields.whole(3, "the number of a node"), fields), {}, "", "", false};
  if (fields.word(4).find("123") == std::string::npos) spider.doubt = "its centre follows in some directions alone";
  double weight = 0.0;
  bool is_first = true;
  constexpr int first = 5;
  for (int i = first; i <= fields.size(); ++i) {
    if (!fields.has(i)) continue;
    const std::string word = fields.word(i);
    if (word == "UM") spider.doubt = "UM chooses what depends on what";
    if (word == "UM" || word == "ALPHA") break;
    if (!is_real(fields.text(i))) {
      spider.feet.push_back(model.node(fields.whole(i, "the number of a node"), fields));
      continue;
    }
    const double given = fields.real(i, "a weight");
    while (++i <= fields.size() && !fields.has(i)) continue;
    const std::string components = fields.word(i);
    if (!is_first && (given != weight || components != spider.components)) spider.doubt = "its weights differ";
    weight = given;
    spider.components = components;
    is_first = false;
  }
  if (spider.components != "123" && spider.doubt.empty())
    spider.doubt = "components " + spider.components + " of the nodes around it: 123 is read";
  return spider;
}

}  // namespace

NastranSpider nastran_spider(const NastranModel& model, const BulkCard& card) {
  const BulkFields fields(model.file(), card);
  NastranSpider spider = card.name == "RBE3" ? mean(model, card, fields) : rigid(model, card, fields);
  std::sort(spider.feet.begin(), spider.feet.end());
  spider.feet.erase(std::unique(spider.feet.begin(), spider.feet.end()), spider.feet.end());
  if (spider.feet.empty()) fields.fail("it has no node around its centre");
  return spider;
}

}  // namespace dygita
