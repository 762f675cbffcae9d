#include "foreign/nastran_cases.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/cards.hpp"
#include "foreign/nastran_bodies.hpp"
#include "foreign/nastran_loads.hpp"
#include "foreign/nastran_spiders.hpp"
#include "foreign/nastran_supports.hpp"

namespace dygita {

namespace {

// Read with the mesh, by the cases, or by what they choose; and what says nothing of the motion.
const std::set<std::string_view> said_or_silent = {
    "GRID",   "GRDSET", "CTETRA",  "CPENTA",  "CHEXA",  "PSOLID", "MAT1",  "MAT9",   "MAT11",  "SET",
    "SET1",   "SET3",   "SPC",     "SPC1",    "SPCADD", "LOAD",   "FORCE", "FORCE1", "PLOAD4", "GRAV",
    "EIGRL",  "EIGR",   "PLOTEL",  "ECHOON",  "RBE2",   "RBE3",   "PBUSH", "PELAS",  "PDAMP",  "PMASS",
    "PGAP",   "PVISC",  "PROD",    "PTUBE",   "PBAR",   "PBARL",  "PBEAM", "PBEAML", "PSHELL", "PCOMP",
    "PCOMPG", "PSHEAR", "PBUSH1D", "ECHOOFF", "MAT2",   "MAT8",   "MDLPRM"};

// What acts only where the case control asks for it, which is told there.
const std::set<std::string_view> asked_elsewhere = {
    "TABLED1", "TABLED2", "TABLEM1", "TABDMP1", "TABLES1", "TABLEST", "FREQ",   "FREQ1", "FREQ2",  "FREQ3", "FREQ4",
    "TSTEP",   "TSTEPNL", "DLOAD",   "TLOAD1",  "TLOAD2",  "RLOAD1",  "RLOAD2", "DAREA", "NLPARM", "EIGC",  "EIGB",
    "MPCADD",  "MPC",     "TEMP",    "TEMPD",   "DMIG",    "SUPORT1", "DPHASE", "DELAY", "DESVAR", "EIGRA"};

bool is_of_places(std::string_view name) { return name.starts_with("CORD1") || name.starts_with("CORD2"); }

class CaseReader {
 public:
  explicit CaseReader(NastranModel& model) : model_(model), file_(model.file()) {}

  NastranAnalysis read() {
    read_case_control(model_, analysis_);
    choose_without_control();
    read_parameters();
    for (const BulkCard& card : file_.cards())
      if (card.name == "RBE2" || card.name == "RBE3")
        attempt([&] { spiders_.push_back(nastran_spider(model_, card)); });
    std::map<long, std::vector<FileAction>> held;
    std::map<long, std::vector<FileAction>> acting;
    for (NastranCase& one : analysis_.cases) {
      if (!held.contains(one.supports)) held[one.supports] = supports_of(one.supports);
      if (!acting.contains(one.loads)) acting[one.loads] = loads_of(one.loads);
      one.held = held[one.supports];
      one.acting = acting[one.loads];
      if (analysis_.kind == NastranAnalysis::Kind::modes) attempt([&] { one.modes = modes_of(one); });
    }
    read_bodies();
    remark_unchosen();
    list_unsaid();
    return std::move(analysis_);
  }

 private:
  template <class Task>
  void attempt(Task&& task) {
    try {
      task();
    } catch (const InputError& error) {
      analysis_.untranslated.emplace_back(error.what());
    }
  }

  std::set<long> sets_of(std::initializer_list<std::string_view> cards) const {
    std::set<long> found;
    for (const BulkCard& card : file_.cards())
      if (std::find(cards.begin(), cards.end(), card.name) != cards.end())
        found.insert(BulkFields(file_, card).whole_or(1, 0, "the number of a set"));
    return found;
  }

  // Bulk data alone: what there is of each kind acts, if there is but one set.
  void choose_without_control() {
    if (!model_.control().empty()) return;
    attempt([&] {
      const auto one = [&](const std::set<long>& sets, const char* kind) {
        if (sets.size() > 1)
          analysis_.untranslated.push_back(
              fmt::format("{}: no case control says which of its {} sets of {} acts", file_.file(), sets.size(), kind));
        return sets.size() == 1 ? *sets.begin() : 0;
      };
      NastranCase& whole = analysis_.cases.front();
      whole.where = file_.file();
      const std::set<long> sums = sets_of({"SPCADD"}), combined = sets_of({"LOAD"});
      whole.supports = one(sums.empty() ? sets_of({"SPC", "SPC1"}) : sums, "supports");
      whole.loads =
          one(combined.empty() ? sets_of({"FORCE", "FORCE1", "MOMENT", "PLOAD4", "GRAV"}) : combined, "loads");
      whole.method = one(sets_of({"EIGRL", "EIGR"}), "methods");
      if (whole.loads == 0 && whole.method != 0) analysis_.kind = NastranAnalysis::Kind::modes;
      analysis_.remarks.push_back(
          fmt::format("{} has no case control: its supports and loads act in one case", file_.file()));
    });
  }

  void read_parameters() {
    const std::set<std::string> of_damping = {"G", "GFL", "ALPHA1", "ALPHA2"};
    for (const BulkCard& card : file_.cards()) {
      if (card.name != "PARAM") continue;
      const BulkFields fields(file_, card);
      const std::string name = fields.word(1), value = fields.word(2);
      if (name == "INREL" && value != "0")
        analysis_.untranslated.push_back(file_.where(card) + ": PARAM INREL: inertia relief");
      if (of_damping.contains(name) && fields.real_or(2, 0.0, "a number") != 0.0)
        analysis_.remarks.push_back(
            fmt::format("{}: PARAM {} = {}: damping of the whole model, which changes neither "
                        "statics nor modes; give it to the materials before a shock",
                        file_.where(card), name, value));
      if (name == "LGDISP" && value != "-1")
        analysis_.remarks.push_back(file_.where(card) +
                                    ": PARAM LGDISP: displacements are small in this program, and the run warns where "
                                    "they are not");
    }
  }

  std::vector<FileAction> supports_of(long set) {
    std::vector<FileAction> actions;
    NastranSupports supports(model_, spiders_);
    attempt([&] { supports.add_permanent(); });
    attempt([&] { actions = supports.of_set(set, analysis_.untranslated); });
    return actions;
  }

  std::vector<FileAction> loads_of(long set) {
    std::vector<FileAction> actions;
    if (set != 0) attempt([&] { actions = NastranLoads(model_, spiders_).of_set(set, analysis_.untranslated); });
    return actions;
  }

  std::string modes_of(const NastranCase& one) {
    for (const BulkCard& card : file_.cards()) {
      if (card.name != "EIGRL" && card.name != "EIGR") continue;
      const BulkFields fields(file_, card);
      if (fields.whole(1, "the number of a method") != one.method) continue;
      const int from = card.name == "EIGR" ? 3 : 2, n = card.name == "EIGR" ? 6 : 4;
      if (fields.real_or(from, 0.0, "a frequency") > 0.0)
        analysis_.remarks.push_back(
            fmt::format("{}: modes below its first frequency are here, too", file_.where(card)));
      if (const long number = fields.whole_or(n, 0, "a number of modes"); number > 0)
        return fmt::format("n = {}", std::min(number, 2000L));
      if (const double up_to = fields.real_or(from + 1, 0.0, "a frequency"); up_to > 0.0)
        return fmt::format("up_to = {:.12g}/time", up_to);
      return "n = 10";
    }
    throw InputError(fmt::format("{}: METHOD {}: there is no EIGRL or EIGR of that number", one.where, one.method));
  }

  void read_bodies() {
    NastranBodies bodies(model_, spiders_, said_);
    for (NastranSpider& spider : spiders_)
      if (!spider.is_said) attempt([&] { bodies.add_body(spider); });
    for (const BulkCard& card : file_.cards())
      if (card.name == "CBUSH" || card.name == "CELAS1" || card.name == "CELAS2")
        attempt([&] {
          said_.insert(&card);  // or told
          bodies.add_spring(card);
        });
    analysis_.bodies = std::move(bodies.bodies);
    analysis_.springs = std::move(bodies.springs);
    analysis_.remarks.insert(analysis_.remarks.end(), bodies.remarks.begin(), bodies.remarks.end());
  }

  // Sets of supports and loads that no case asks for.
  void remark_unchosen() {
    std::set<std::pair<bool, long>> chosen;
    for (const NastranCase& one : analysis_.cases) {
      chosen.insert({true, one.supports});
      chosen.insert({false, one.loads});
    }
    for (const BulkCard& card : file_.cards()) {
      if (card.name != "SPCADD" && card.name != "LOAD") continue;
      const BulkFields fields(file_, card);
      const bool is_sum = card.name == "SPCADD";
      for (int i = is_sum ? 2 : 4; i <= fields.size(); i += is_sum ? 1 : 2)
        attempt([&] {
          if (fields.has(i) && chosen.contains({is_sum, fields.whole(1, "a set")}))
            chosen.insert({is_sum, fields.whole(i, "a set")});
        });
    }
    std::set<std::string> left;
    for (const BulkCard& card : file_.cards()) {
      const bool is_support = card.name == "SPC" || card.name == "SPC1";
      if (!is_support && card.name != "FORCE" && card.name != "FORCE1" && card.name != "PLOAD4" && card.name != "GRAV")
        continue;
      attempt([&] {
        const long set = BulkFields(file_, card).whole(1, "a set");
        if (!chosen.contains({is_support, set}) && left.insert(fmt::format("{} {}", card.name, set)).second)
          analysis_.remarks.push_back(
              fmt::format("{}: {} of set {}: no case asks for it", file_.where(card), card.name, set));
      });
    }
  }

  void list_unsaid() {
    std::map<std::string_view, std::vector<std::string>> others;
    for (const BulkCard& card : file_.cards())
      if (!said_or_silent.contains(card.name) && !said_.contains(&card) && !model_.is_skipped(card.name) &&
          !is_of_places(card.name) && card.name != "PARAM")
        others[card.name].push_back(file_.where(card));
    for (const auto& [name, places] : others) {
      const std::string lines = few_of(places);
      if (asked_elsewhere.contains(name))
        analysis_.remarks.push_back(fmt::format("{}: {}: no case says it in this deck", lines, name));
      else
        analysis_.untranslated.push_back(
            fmt::format("{}: {}: a deck has no word for it", lines, printable(std::string(name))));
    }
    for (const NastranSpider& spider : spiders_)
      if (!spider.is_said)
        analysis_.untranslated.push_back(fmt::format("{}: {}: a deck has no word for what is attached to it",
                                                     file_.where(*spider.card), spider.card->name));
  }

  NastranModel& model_;
  const BulkFile& file_;
  NastranAnalysis analysis_;
  std::vector<NastranSpider> spiders_;
  std::set<const BulkCard*> said_;
};

}  // namespace

NastranAnalysis analysis_of(NastranModel& model) { return CaseReader(model).read(); }

}  // namespace dygita
