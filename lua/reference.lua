-- The reference of the deck language as Markdown, printed from the schema.
local native = ...
local schema = native.module "schema"
local units = native.module "units"

local lines = {}
local function put(format, ...) lines[#lines + 1] = format:format(...) end

local function number(x) return ("%g"):format(x) end

local function type_of(argument)
  local names = { vector = "{ x, y, z }", placement = "{ x, y, z } or table", orientation = "{ axis1, axis2 }, function(x, y, z) or table", counts = "{ nx, ny, nz }", numbers = "list of numbers", name = "text",
                  settings = "table of numbers", compliance = "table", tables = "list of tables", pairs = "list of pairs", distributions = "table of distributions", specification = "file or list of { frequency, level }", value = "number, history or function(t)", integer = "whole number",
                  choice = "text", choices = "list of texts", directions = "text, or { x, y, z } by name" }
  local text = names[argument.type] or argument.type
  if argument.kinds then text = table.concat(argument.kinds, " or ") .. (argument.or_names and " or name" or "") end
  if argument.type == "numbers" and argument.or_single then return "number or list of numbers" end
  if argument.exactly then text = ("list of %d: %s"):format(argument.exactly, text)
  elseif argument.or_single then text = text .. ", or a list"
  elseif argument.type == "objects" or argument.type == "except" then text = "list of " .. text end
  if argument.or_function then text = text .. ", function(x, y, z)" end
  if argument.or_word then text = ('%s or "%s"'):format(text, argument.or_word) end
  if argument.or_table then text = text .. " or table" end
  if argument.by_direction then text = text .. ", or by direction" end
  return text
end

local function default_of(argument)
  local default = argument.default
  if argument.required_unless then return ('required but with "%s"'):format(argument.required_unless[2]) end
  if argument.required then return "required" end
  if argument.default_doc then return argument.default_doc end
  if type(default) == "table" then return #default == 0 and "none" or "{ " .. table.concat(default, ", ") .. " }" end
  if type(default) == "number" then return number(default) end
  return default ~= nil and tostring(default) or ""
end

local function allowed(argument)
  if argument.choices then return table.concat(argument.choices, ", ") end
  local range = argument.range
  if not range then return "" end
  return ("%s to %s"):format(number(range[1]), number(argument.later_above or range[2]))
end

local function rows_of(name, fields)
  for _, f in ipairs(fields or {}) do
    put("| `%s.%s` | %s | %s | %s | %s | %s |", name, f[1], type_of(f), f.unit or "", default_of(f), allowed(f), f.doc)
    rows_of(name .. "." .. f[1], f.fields)
  end
end

local function table_of(arguments)
  if #arguments == 0 then return end
  put "| argument | type | unit | default | plausible | meaning |"
  put "| --- | --- | --- | --- | --- | --- |"
  for _, a in ipairs(arguments) do
    put("| `%s` | %s | %s | %s | %s | %s |", a[1], type_of(a), a.unit or "", default_of(a), allowed(a), a.doc)
    rows_of(a[1], a.fields)
  end
  put ""
end

local function entry_of(title, entry)
  put("### %s\n", title)
  put("%s\n", entry.doc)
  if entry.argument then table_of { entry.argument } end
  if entry.argument and entry.arguments then put "Or a table:\n" end
  if entry.arguments then table_of(entry.arguments) end
  if entry.one_of then put("At least one of `%s`.\n", table.concat(entry.one_of, "`, `")) end
  if entry.later then put("Not built yet: `%s`.\n", table.concat(entry.later, "`, `")) end
end

put "# Reference of the deck language\n"
put("Printed by `dygita schema` of dygita %s from `lua/schema.lua`.\n", native.version)
for _, word in ipairs(schema.words) do
  put("## %s\n", word.name)
  put("%s\n", word.doc)
  if word.call then entry_of(("`%s{ ... }`"):format(word.name), word.call) end
  for _, entry in ipairs(word) do entry_of(("`%s.%s{ ... }`"):format(word.name, entry[1]), entry) end
  if word.later and not word.call then
    put("Not built yet: `%s.%s`.\n", word.name, table.concat(word.later, ("`, `%s."):format(word.name)))
  end
end

put "## Distributions\n"
put "Values of `vary` in an ensemble. Numbers scale them: `uniform(0.7, 1.3)*30*kN`.\n"
put "| written | meaning |"
put "| --- | --- |"
for _, entry in ipairs(schema.distributions) do
  local texts = {}
  for i, a in ipairs(entry.arguments) do texts[i] = ("%s: %s"):format(a[1], a.doc) end
  put("| `%s` | %s %s |", entry.write, entry.doc, table.concat(texts, "; "))
end
put ""

put "## Methods\n"
for _, entry in ipairs(schema.methods) do entry_of(("`%s`"):format(entry.write), entry) end

put "## param\n"
put("`param{ mu = 0.2, n = 4 }` declares, once in a deck, the numbers that the command line may override: `--set mu=0.3`, "
  .. "`--set tighten=0.04*mm`. It returns them by name.\n")

for _, kind in ipairs { "bolt", "list of bolts", "frame" } do
  put("## Fields of a %s\n", kind)
  put "| written | kind | meaning |"
  put "| --- | --- | --- |"
  for _, field in ipairs(schema.fields[kind]) do
    put("| `%s.%s` | %s | %s |", kind == "list of bolts" and "bolts" or kind, field[1], (field.is_list and "list of " or "") .. field.kind, field.doc)
  end
  put ""
end

put "## Reading results\n"
put "| written | answers |"
put "| --- | --- |"
for _, row in ipairs(schema.reading) do put("| `%s` | %s |", row[1], row[2]) end

put "\n## Units\n"
put "Units are numbers in SI: `20*mm` in, `x / um` out.\n"
local names = {}
for name in pairs(units) do names[#names + 1] = name end
table.sort(names, function(a, b) return a:lower() < b:lower() or (a:lower() == b:lower() and a < b) end)
put "| unit | SI |"
put "| --- | --- |"
for _, name in ipairs(names) do put("| `%s` | %s |", name, number(units[name])) end

return table.concat(lines, "\n") .. "\n"
