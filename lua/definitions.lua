-- The deck language as definitions for editors (annotations of LuaLS and EmmyLua), printed from the schema: completion, hover with unit,
-- default and range, and checks of types, missing arguments and unknown words while a deck is written.
local native = ...
local schema = native.module "schema"
local units = native.module "units"
local environment = native.module "environment"

local lines = {}
local function put(format, ...) lines[#lines + 1] = format:format(...) end

local function number(x) return ("%g"):format(x) end

-- "interface.plastic", "mesh file" -> "dygita.interface.plastic", "dygita.mesh_file".
local function class_of(name) return "dygita." .. name:gsub(" ", "_") end
local function arguments_of(path) return class_of(path:gsub(":", ".")) .. ".arguments" end

local function union(names, wrap)
  local texts = {}
  for i, name in ipairs(names) do texts[i] = wrap(name) end
  return table.concat(texts, "|")
end

local function grouped(type_text) return type_text:find("|", 1, true) and "(" .. type_text .. ")" or type_text end

local plain = {
  number = "number", integer = "integer", boolean = "boolean", name = "string", text = "string", file = "string",
  vector = "dygita.vector", counts = "dygita.counts", numbers = "number[]", texts = "string|string[]", settings = "table<string, number>",
  specification = "string|number[][]", pairs = "number[][]", value = "dygita.value", distributions = "table<string, dygita.distribution|number[]|{ [1]: dygita.distribution|number[], each: table }>",
  ["function"] = "fun(x: number, y: number, z: number): boolean?",
  frame = "dygita.frame", directions = "string|table<string, dygita.vector>", table = "table<string, dygita.output>",
}

local type_of

local function inline_table(fields)
  local texts = {}
  for i, f in ipairs(fields) do texts[i] = ("%s%s: %s"):format(f[1], f.required and "" or "?", type_of(f)) end
  return "{ " .. table.concat(texts, ", ") .. " }"
end

function type_of(a)
  local text = a.signature or (a.type ~= "table" and plain[a.type] or nil)
  if a.type == "choice" then text = union(a.choices, function(word) return ('"%s"'):format(word) end) end
  if a.type == "choices" then text = grouped(union(a.choices, function(word) return ('"%s"'):format(word) end)) .. "[]" end
  if a.type == "table" or a.type == "compliance" then text = inline_table(a.fields) end
  if a.type == "tables" then text = inline_table(a.fields) .. "[]" end
  if a.type == "placement" then text = "dygita.vector|" .. inline_table(a.fields) end
  if a.type == "orientation" then
    text = "[dygita.vector, dygita.vector]|(fun(x: number, y: number, z: number): dygita.vector, dygita.vector)|" .. inline_table(a.fields)
  end
  if a.kinds then
    local one = union(a.kinds, class_of) .. (a.or_names and "|string" or "")
    if a.type == "object" then text = one
    elseif a.type == "except" then text = ("(%s|[%s, %s])[]"):format(one, class_of "substructure", class_of "substructure")
    elseif a.exactly then text = "[" .. (one .. ", "):rep(a.exactly - 1) .. one .. "]"
    else text = grouped(one) .. "[]" end
    if a.or_single or a.or_names then text = one .. "|" .. text end
    if a.type == "between" and a.or_word then text = text .. ("|[string|%s|%s[], string|%s|%s[]]"):format(class_of "substructure", class_of "substructure", class_of "substructure", class_of "substructure") end
  end
  assert(text, "lua/definitions.lua knows no type '" .. tostring(a.type) .. "'")
  if a.by_direction then text = ("%s|table<string, %s>"):format(text, text) end
  if a.or_word then text = ('%s|"%s"'):format(text, a.or_word) end
  if a.or_function then text = text .. "|(fun(x: number, y: number, z: number): number)" end
  if a.or_table then text = text .. "|" .. inline_table(a.or_table) end
  return text
end

local function default_of(a)
  if a.required_unless then return ('required but with "%s"'):format(a.required_unless[2]) end
  if a.required then return "required" end
  if a.default_doc then return "default: " .. a.default_doc end
  local default = a.default
  if default == nil then return nil end
  if type(default) == "table" then return #default == 0 and "default: none" or "default: { " .. table.concat(default, ", ") .. " }" end
  return "default: " .. (type(default) == "number" and number(default) or tostring(default))
end

-- "Young's modulus. Pa, 1e+06 to 2e+12, required"
local function text_of(a)
  local notes = {}
  if a.unit then notes[#notes + 1] = a.unit end
  if a.range then notes[#notes + 1] = ("%s to %s"):format(number(a.range[1]), number(a.later_above or a.range[2])) end
  notes[#notes + 1] = default_of(a)
  return a.doc .. (#notes > 0 and ". " .. table.concat(notes, ", ") or "")
end

local function put_fields(arguments)
  for _, a in ipairs(arguments) do
    put("---@field %s%s %s # %s", a[1], a.required and not a.required_unless and "" or "?", type_of(a), text_of(a))
    for _, f in ipairs(a.fields or {}) do put("--- `%s.%s`: %s", a[1], f[1], text_of(f)) end
  end
end

local function put_doc(entry)
  put("--- %s", entry.doc)
  if entry.one_of then put("---\n--- At least one of `%s`.", table.concat(entry.one_of, "`, `")) end
end

local function needs_argument(arguments)
  for _, a in ipairs(arguments) do
    if a.required then return true end
  end
  return false
end

-- A constructor with the classes of its arguments and of what it answers.
local function put_constructor(path, entry)
  local made = path == entry.makes and class_of(path) or class_of(path) .. ": " .. class_of(entry.makes)
  put("---@class (exact) %s", arguments_of(path))
  put_fields(entry.arguments)
  put ""
  if not entry.expands then
    put("---@class %s%s %s", made, made:find(":", 1, true) and "," or ":", arguments_of(path))
    if path == entry.makes then
      for _, field in ipairs(schema.fields[path] or {}) do put("---@field %s %s # %s", field[1], plain[field.kind], field.doc) end
    end
    put ""
  end
  put_doc(entry)
  put("---@param arguments%s %s", needs_argument(entry.arguments) and "" or "?", arguments_of(path))
  put("---@return %s", entry.returns or entry.expands and class_of "substructure" .. "[]|" .. class_of "list of bolts" or class_of(path) .. (entry.or_list and "|" .. class_of(entry.or_list) or ""))
  put("function %s(arguments) end\n", path)
end

-- A word that is called itself and has members.
local function put_callable(word)
  local path = word.name
  put("---@class (exact) %s", arguments_of(path))
  put_fields(word.call.arguments)
  put ""
  put("---@class %s: %s", class_of(path), arguments_of(path))
  put ""
  put_doc(word.call)
  put("---@class %s", class_of("word." .. path))
  put("---@overload fun(arguments: %s): %s", arguments_of(path), class_of(path))
  put("%s = {}\n", path)
  for _, entry in ipairs(word) do put_constructor(path .. "." .. entry[1], entry) end
end

-- Classes that only methods and constructors name: a part's face, and whatever several constructors make.
local function put_kinds()
  local known, own = {}, {}
  local function add(kind)
    if not known[kind] and not own[kind] then
      known[kind] = true
      known[#known + 1] = kind
    end
  end
  for _, word in ipairs(schema.words) do
    if word.call then own[word.call.makes] = true end
    for _, entry in ipairs(word) do
      if not entry.expands then add(entry.makes) end
    end
  end
  add "list of bolts"
  add "list of spectra"
  for _, entry in ipairs(schema.methods) do
    add(entry.kind)
    if entry.makes then add(entry.makes) end
  end
  for _, kind in ipairs(known) do
    if kind ~= "result" and kind ~= "history" then put("---@class %s", class_of(kind)) end
    for _, field in ipairs(schema.fields[kind] or {}) do
      put("---@field %s %s # %s", field[1], plain[field.kind] or class_of(field.kind) .. (field.is_list and "[]" or ""), field.doc)
    end
    if kind ~= "result" and kind ~= "history" then put "" end
  end
end

local function put_method(entry)
  local holder = "of_" .. entry.kind:gsub(" ", "_")
  put_doc(entry)
  put("---")
  put("--- `%s`", entry.write)
  local a = entry.argument
  if a then
    local parameter = a[1] == "function" and "is_in" or a[1]
    local or_table = entry.arguments and "|" .. arguments_of(entry.kind .. ":" .. entry[1]) or ""
    put("---@param %s %s # %s", parameter, type_of(a) .. or_table, text_of(a))
    if entry.makes then put("---@return %s", class_of(entry.makes) .. (entry.is_list and "[]" or "")) end
    put("function %s:%s(%s) end\n", holder, entry[1], parameter)
  elseif not entry.arguments then
    put("---@return %s", plain[entry.answers])
    put("function %s:%s() end\n", holder, entry[1])
  else
    put("---@param arguments%s %s", needs_argument(entry.arguments) and "" or "?", arguments_of(entry.kind .. ":" .. entry[1]))
    if entry.makes then put("---@return %s", class_of(entry.makes)) end
    put("function %s:%s(arguments) end\n", holder, entry[1])
  end
end

local function put_methods()
  local holders = {}
  for _, entry in ipairs(schema.methods) do
    if entry.arguments then
      put("---@class (exact) %s", arguments_of(entry.kind .. ":" .. entry[1]))
      put_fields(entry.arguments)
      put ""
    end
    if not holders[entry.kind] then
      put("---@class %s", class_of(entry.kind))
      put("local of_%s = {}\n", (entry.kind:gsub(" ", "_")))
      holders[entry.kind] = true
    end
    put_method(entry)
  end
end

-- What decks have of Lua beside its tables of functions: those are the editor's own.
local of_lua = {
  ipairs = "---@generic T: table, V\n---@param t T\n---@return fun(table: V[], i?: integer): integer, V\n---@return T\n---@return integer i\nfunction ipairs(t) end",
  pairs = "---@generic T: table, K, V\n---@param t T\n---@return fun(table: table<K, V>, index?: K): K, V\n---@return T\nfunction pairs(t) end",
  next = "---@generic K, V\n---@param table table<K, V>\n---@param index? K\n---@return K?\n---@return V?\nfunction next(table, index) end",
  select = '---@param index integer|"#"\n---@return any ...\nfunction select(index, ...) end',
  type = '---@param v any\n---@return "nil"|"number"|"string"|"boolean"|"table"|"function"|"userdata"\nfunction type(v) end',
  tonumber = "---@param e any\n---@param base? integer\n---@return number?\nfunction tonumber(e, base) end",
  tostring = "---@param v any\n---@return string\nfunction tostring(v) end",
  error = "---@param message any\n---@param level? integer\nfunction error(message, level) end",
  assert = "---@generic T\n---@param v? T\n---@param message? any\n---@return T\n---@return any ...\nfunction assert(v, message, ...) end",
  print = "function print(...) end",
  near = "--- Whether two coordinates (m) are the same but for round-off, or within a distance.\n---@param a number\n---@param b number\n---@param by? number\n---@return boolean\nfunction near(a, b, by) end",
}
local tables_of_lua = { math = true, string = true, table = true }

local function sorted(members)
  local names = {}
  for name in pairs(members) do names[#names + 1] = name end
  table.sort(names)
  return names
end

put "---@meta dygita"
put("-- Definitions of the deck language for editors, printed by `dygita schema --lua` of dygita %s. Units are SI.", native.version)
put "-- How to use them: manual/editors.md.\n"
put "---@alias dygita.vector [number, number, number]"
put "---@alias dygita.counts [integer, integer, integer]"
put "---@alias dygita.value number|dygita.history|fun(t: number): number\n"
put_kinds()
put "---@class dygita.history"
put "---@operator add(dygita.history|number): dygita.history"
put "---@operator sub(dygita.history|number): dygita.history"
put "---@operator mul(number): dygita.history"
put "---@operator div(number): dygita.history"
put "---@operator unm: dygita.history\n"

for _, word in ipairs(schema.words) do
  if word.call and #word == 0 then
    put_constructor(word.name, word.call)
  elseif word.call then
    put_callable(word)
  else
    put("--- %s", word.doc)
    put("%s = {}\n", word.name)
    for _, entry in ipairs(word) do put_constructor(word.name .. "." .. entry[1], entry) end
  end
end

put_methods()

put "---@class dygita.distribution"
put "---@operator mul(number): dygita.distribution"
put "---@operator div(number): dygita.distribution"
put "---@operator unm: dygita.distribution\n"
for _, entry in ipairs(schema.distributions) do
  put("--- %s", entry.doc)
  local names = {}
  for i, a in ipairs(entry.arguments) do
    put("---@param %s number # %s", a[1], a.doc)
    names[i] = a[1]
  end
  put "---@return dygita.distribution"
  put("function %s(%s) end\n", entry[1], table.concat(names, ", "))
end

put "--- The numbers of the deck that the command line may override: `--set mu=0.3`. Once in a deck."
put "---@generic T: table"
put "---@param values T"
put "---@return T"
put "function param(values) end\n"

put "--- A column of an output."
put "---@class dygita.series"
put "---@field [integer] number # a row, from 1"
put "---@field max number # largest value"
put "---@field min number # smallest value"
put "---@field first number"
put "---@field last number"
put "---@field time dygita.series # s"
put "---@field frequency dygita.series # Hz, of a spectrum"
put "---@operator len: integer"
put "local of_series = {}\n"
put "--- The value at a time (s), linear between rows, or in the last row of a step."
put "---@param when number|dygita.step"
put "---@return number"
put "function of_series:at(when) end\n"
put "--- The data of an output: its columns by their names, and:"
put "---"
for _, row in ipairs(schema.reading) do put("--- - `%s`: %s", row[1], row[2]) end
put "---@class dygita.data: dygita.series"
put "---@field [string] any # a column, a table or a number of the output\n"
put "---@class dygita.result"
put "---@field [dygita.output] dygita.data"
put "---@field iterations integer # of all steps"
put "---@field mean_iterations number # per increment"
put "---@field converged boolean # whether every increment converged\n"

put "-- Units: numbers in SI, 20*mm in, x / um out."
for _, name in ipairs(sorted(units)) do put("---@type number\n%s = %s", name, ("%.17g"):format(units[name])) end
put ""
for _, name in ipairs(sorted(environment.functions)) do
  if not tables_of_lua[name] then put("%s\n", assert(of_lua[name], "lua/definitions.lua lacks " .. name)) end
end

return table.concat(lines, "\n") .. "\n"
