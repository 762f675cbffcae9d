#include "fuzz/grammar.hpp"

#include <algorithm>
#include <cmath>
#include <lua.hpp>
#include <memory>
#include <regex>
#include <set>

#include "deck/embedded_lua.hpp"
#include "fuzz/target.hpp"

namespace dygita::fuzz {

namespace {

std::string text_at(lua_State* L, const char* key) {
  lua_getfield(L, -1, key);
  const std::string text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return text;
}

bool is_true_at(lua_State* L, const char* key) {
  lua_getfield(L, -1, key);
  const bool is_true = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return is_true;
}

// Calls `take` with each item of the list at a key (or of the value on top, where key is null) on top of the stack.
template <class Take>
void each(lua_State* L, const char* key, Take&& take) {
  luaL_checkstack(L, 8, nullptr);
  if (key)
    lua_getfield(L, -1, key);
  else
    lua_pushvalue(L, -1);
  const lua_Integer n = lua_istable(L, -1) ? static_cast<lua_Integer>(lua_rawlen(L, -1)) : 0;
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_geti(L, -1, i);
    take();
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

std::vector<std::string> texts(lua_State* L, const char* key) {
  std::vector<std::string> all;
  each(L, key, [&] {
    if (lua_type(L, -1) == LUA_TSTRING) all.emplace_back(lua_tostring(L, -1));
  });
  return all;
}

Argument argument_at(lua_State* L) {
  Argument a;
  lua_geti(L, -1, 1);
  if (lua_type(L, -1) == LUA_TSTRING) a.name = lua_tostring(L, -1);
  lua_pop(L, 1);
  a.type = text_at(L, "type"), a.unit = text_at(L, "unit");
  std::vector<double> range;
  each(L, "range", [&] { range.push_back(lua_tonumber(L, -1)); });
  if (range.size() == 2) a.low = range[0], a.high = range[1];
  a.is_required = is_true_at(L, "required"), a.may_be_single = is_true_at(L, "or_single");
  a.choices = texts(L, "choices"), a.kinds = texts(L, "kinds");
  each(L, "fields", [&] { a.fields.push_back(argument_at(L)); });
  each(L, "or_table", [&] { a.fields.push_back(argument_at(L)); });
  if (const std::string word = text_at(L, "or_word"); !word.empty()) a.choices.push_back(word);
  return a;
}

Entry entry_at(lua_State* L, const std::string& path) {
  Entry entry{path, text_at(L, "makes"), {}};
  each(L, "arguments", [&] { entry.arguments.push_back(argument_at(L)); });
  return entry;
}

std::string name_at(lua_State* L) {
  lua_geti(L, -1, 1);
  const std::string name = lua_tostring(L, -1);
  lua_pop(L, 1);
  return name;
}

// The schema asks `native` for one module, of which it takes a list of sizes.
int sizes_of_bolts(lua_State* L) {
  luaL_dostring(L, "return { sizes = { 'M6', 'M8', 'M12' } }");
  return 1;
}

void read_words(lua_State* L, Grammar& all) {
  each(L, "words", [&] {
    const std::string word = text_at(L, "name");
    lua_getfield(L, -1, "call");
    if (lua_istable(L, -1)) all.entries.push_back(entry_at(L, word));
    lua_pop(L, 1);
    each(L, nullptr, [&] { all.entries.push_back(entry_at(L, word + "." + name_at(L))); });
  });
  each(L, "methods", [&] { all.entries.push_back(entry_at(L, text_at(L, "kind") + ":" + name_at(L))); });
}

Grammar read_grammar() {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  lua_State* const L = state.get();
  luaL_openlibs(L);
  demand(luaL_loadstring(L, embedded_lua().at("schema").c_str()) == LUA_OK, "the schema loads");
  lua_newtable(L);
  lua_pushcfunction(L, sizes_of_bolts);
  lua_setfield(L, -2, "module");
  demand(lua_pcall(L, 1, 1, 0) == LUA_OK, "the schema runs");
  Grammar all;
  read_words(L, all);
  demand(all.entries.size() > 40, "the schema has the language");
  std::set<std::string> words;
  for (const Entry& entry : all.entries) {
    words.insert(entry.member());
    for (const Argument& a : entry.arguments) {
      words.insert(a.name);
      words.insert(a.choices.begin(), a.choices.end());
    }
  }
  all.words.assign(words.begin(), words.end());
  return all;
}

bool fits(const std::string& kind, const std::string& wanted) {
  return kind == wanted || kind.starts_with(wanted + ".") || (kind == "mesh.box" && wanted == "mesh");
}

const std::vector<std::string> units = {"mm", "um", "ms", "us", "kN", "kPa", "MPa", "GPa", "Hz", "kHz", "g0", "deg"};

std::string unit_like(const std::string& unit, Random& random) {
  static const std::vector<std::pair<std::string, std::string>> of = {{"m", "mm"}, {"s", "us"},   {"Pa", "MPa"},
                                                                      {"N", "kN"}, {"Hz", "kHz"}, {"m/s^2", "g0"}};
  for (const auto& [si, text] : of)
    if (si == unit && chance(0.6, random)) return "*" + text;
  return chance(0.03, random) ? "*" + one_of(units, random) : "";
}

double size_of(const std::string& unit) {
  if (unit.starts_with("*mm")) return 1e-3;
  if (unit.starts_with("*us")) return 1e-6;
  return unit.starts_with("*MPa") ? 1e6 : unit.starts_with("*k") ? 1e3 : unit.starts_with("*g0") ? 9.8 : 1.0;
}

std::string number_within(const Argument& a, Random& random) {
  if (chance(0.08, random)) return any_number(random);
  const std::string unit = unit_like(a.unit, random);
  const double share = static_cast<double>(random() % 1001) / 1000.0;
  double x = a.low + share * (a.high - a.low);
  if (a.low > 0 && a.high > 10 * a.low) x = a.low * std::pow(a.high / a.low, share);
  if (chance(0.1, random)) x = chance(0.5, random) ? a.low : a.high;
  if (a.low <= 0 && a.high > 100 && chance(0.7, random)) x = share * 10 * size_of(unit);
  if (a.type == "integer" || a.type == "counts") return std::to_string(1 + random() % (chance(0.9, random) ? 3 : 400));
  return fmt::format("{:.6g}{}", x / size_of(unit), unit);
}

std::string list_of(size_t n, const std::function<std::string()>& item) {
  std::string text = "{ ";
  for (size_t i = 0; i < n; ++i) text += (i ? ", " : "") + item();
  return text + " }";
}

std::string object_for(const Argument& a, const Declared& declared, Random& random) {
  std::vector<std::string> names;
  for (const auto& [kind, name] : declared)
    for (const std::string& wanted : a.kinds)
      if (fits(kind, wanted)) names.push_back(name);
  if (!names.empty() && !chance(0.05, random)) return one_of(names, random);
  return declared.empty() ? "nil" : one_of(declared, random).second;
}

std::string table_of(const Argument& a, const Declared& declared, Random& random) {
  std::string text = "{ ";
  for (const Argument& field : a.fields)
    if (field.is_required ? chance(0.95, random) : chance(0.4, random)) text += text_of(field, declared, random) + ", ";
  return text + "}";
}

std::string time_value(const Argument& a, Random& random) {
  static const std::vector<std::string> shapes = {"history.half_sine{{ peak = {0}, duration = 5*us }}",
                                                  "history.ramp{{ to = {0}, duration = 5*us }}",
                                                  "history.haversine{{ peak = {0}, duration = 2*us }}",
                                                  "history.step{{ value = {0}, at = 1*us }}",
                                                  "history.piecewise{{ times = {{ 0, 1*us }}, values = {{ 0, {0} }} }}",
                                                  "function(t) return {0}*t end",
                                                  "function(t) return t > 1*us and {0} or 0 end"};
  const std::string number = number_within(a, random);
  return chance(0.5, random) ? number : fmt::format(fmt::runtime(one_of(shapes, random)), number);
}

const std::vector<std::string> functions = {
    "function(x, y, z) return near(z, 0) end", "function(x, y, z) return x > y end", "function(x, y, z) return x end",
    "function(x, y, z) end", "function(x, y, z) return near(x, 10*mm) and near(y, 0) end"};

}  // namespace

const Entry* Grammar::entry(const std::string& path) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.path == path; });
  return found == entries.end() ? nullptr : &*found;
}

const Grammar& grammar() {
  static const Grammar all = read_grammar();
  return all;
}

Declared declared_in(const std::string& deck) {
  static const std::regex declaration(R"(local\s+([A-Za-z_]\w*)\s*=\s*([a-z_]+(?:[.:][a-z_]+)?))");
  Declared all;
  for (std::sregex_iterator it(deck.begin(), deck.end(), declaration), end; it != end; ++it) {
    const std::string name = (*it)[1], path = (*it)[2];
    all.emplace_back(path, name);
    if (path == "substructure")
      for (const char* side : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
        all.emplace_back("face", fmt::format("{}:face \"{}\"", name, side));
    if (path.ends_with(":face")) all.emplace_back("face", name);
    if (path.ends_with(":where")) all.emplace_back("region", name);
    if (path.ends_with(":run")) all.emplace_back("result", name);
  }
  return all;
}

std::string any_number(Random& random) {
  static const std::vector<std::string> odd = {
      "0",   "-1",  "1e308", "-1e308", "1e-308",          "0/0",  "1/0", "-1/0", "5e-324", "2^53", "2^63",
      "1e9", "0.1", "-0.0",  "1e-12",  "math.maxinteger", "2^31", "3",   "1.5",  "1e15",   "65537"};
  return one_of(odd, random);
}

std::string any_value(const Declared& declared, Random& random) {
  static const std::vector<std::string> odd = {"nil",
                                               "true",
                                               "\"\"",
                                               "{}",
                                               "{ {} }",
                                               "\"all touching\"",
                                               "print",
                                               "function() end",
                                               "{ 1, 2, 3 }",
                                               "{ name = 1 }",
                                               "\"\\0\\27[2J\"",
                                               "_G",
                                               "{ 1, nil, 3 }",
                                               "{ [3] = 1 }",
                                               "history.step{ value = 1, at = 0 }"};
  if (chance(0.3, random)) return any_number(random);
  if (!declared.empty() && chance(0.4, random)) return one_of(declared, random).second;
  return one_of(odd, random);
}

std::string value_for(const Argument& a, const Declared& declared, Random& random) {
  const auto number = [&] { return number_within(a, random); };
  const auto object = [&] { return object_for(a, declared, random); };
  const size_t few = 1 + random() % 3;
  if (chance(0.05, random)) return any_value(declared, random);
  if (!a.choices.empty() && (a.type.starts_with("choice") || chance(0.2, random))) {
    const auto choice = [&] { return "\"" + one_of(a.choices, random) + "\""; };
    return a.type == "choices" ? list_of(few, choice) : choice();
  }
  if (!a.fields.empty() && (a.type == "table" || a.type == "compliance" || chance(0.3, random)))
    return table_of(a, declared, random);
  if (a.type == "tables") return list_of(few, [&] { return table_of(a, declared, random); });
  if (a.type == "boolean") return chance(0.5, random) ? "true" : "false";
  if (a.type == "name" || a.type == "text") return fmt::format("\"n{}\"", random() % 100);
  if (a.type == "file") return chance(0.7, random) ? "\"shock_in_g.csv\"" : "\"no.csv\"";
  if (a.type == "vector" || a.type == "counts" || a.type == "placement") return list_of(3, number);
  if (a.type == "orientation")
    return chance(0.3, random) ? one_of(functions, random) : list_of(2, [&] { return list_of(3, number); });
  if (a.type == "numbers") return a.may_be_single && chance(0.4, random) ? number() : list_of(few, number);
  if (a.type == "settings") return "{ n" + std::to_string(random() % 10) + " = " + number() + " }";
  if (a.type == "specification") return "{ { 100, 10 }, { " + number() + ", 20 } }";
  if (a.type == "pairs") return "{ { 1e-6, " + number() + " }, { 2e-6, 1e8 } }";
  if (a.type == "value") return time_value(a, random);
  if (a.type == "frame") return "frame{ angle = " + number() + ", origin = " + list_of(3, number) + " }";
  if (a.type == "directions") return chance(0.5, random) ? "\"xyz\"" : "{ up = " + list_of(3, number) + " }";
  if (a.type == "between") return list_of(2, object);
  if (a.type == "object") return object();
  if (a.type == "objects" || a.type == "except")
    return a.may_be_single && chance(0.5, random) ? object() : list_of(few, object);
  if (a.type == "function") return one_of(functions, random);
  return number();
}

std::string text_of(const Argument& a, const Declared& declared, Random& random) {
  return a.name + " = " + value_for(a, declared, random);
}

std::string statement(const Declared& declared, Random& random) {
  const Entry& entry = one_of(grammar().entries, random);
  std::string call = entry.path;
  if (entry.is_method()) {
    Argument self;
    self.kinds = {entry.path.substr(0, entry.path.find(':'))};
    call = object_for(self, declared, random) + ":" + entry.member();
  }
  std::string arguments;
  for (const Argument& a : entry.arguments)
    if (chance(a.is_required ? 0.97 : 0.3, random)) arguments += text_of(a, declared, random) + ", ";
  return fmt::format("local x{} = {}{{ {}}}\n", random() % 1000, call, arguments);
}

}  // namespace dygita::fuzz
