-- Values that the command line gives to a deck: --set tighten=0.04*mm and --solver 'latin{ window = 5 }'.
local native = ...
local schema = native.module "schema"
local units = native.module "units"
local check = native.module "check"

local function names_of(members)
  local names = {}
  for name in pairs(members) do names[#names + 1] = name end
  return names
end

-- The expression `text` as a function that knows units and nothing else, or nothing where it is no Lua.
local function compile(text, place, option)
  local known = setmetatable({}, {
    __index = function(_, key)
      local value = units[key]
      if value ~= nil or key == "math" then return value or math end
      native.refuse(("%s: '%s' is not a unit\n    %s"):format(place, key, native.did_you_mean(key, names_of(units))))
    end,
  })
  return native.compile("return " .. text, known, option)
end

-- The number that an expression in units stands for.
local function evaluate(text, place, option, example)
  local expression = text:find "^[%w%s%.%+%-%*/%^%(%)_]+$" and compile(text, place, option)
  local value = expression and expression()
  if type(value) ~= "number" or value ~= value or value == math.huge or value == -math.huge then
    native.refuse(("%s is neither a number nor an expression in units, as in %s"):format(place, example))
  end
  return value
end

-- A parameter's value, a number in units.
local function parameter(name, text)
  return evaluate(text, ("--set %s=%s"):format(name, text), "--set", "--set tighten=0.04*mm")
end

-- The value of another option, a time.
local function quantity(option, text) return evaluate(text, option .. " " .. text, option, option .. " 0.4*ms") end

local solvers = {}
for _, word in ipairs(schema.words) do
  if word.name == "solver" then
    for _, entry in ipairs(word) do solvers[entry[1]] = entry end
  end
end

-- The solver of --solver, declared at a line of the deck; nothing where the option is not given.
local function solver(line)
  if native.solver == "" then return nil end
  local place = "--solver " .. native.solver
  local text = native.solver:gsub("^solver%.", ""):gsub("%s", " ")
  local name = text:match "^[%w_]*"
  local rest = text:sub(#name + 1)
  local entry = solvers[name]
  if not entry then
    native.refuse(("%s: no solver '%s'\n    %s"):format(place, name, native.did_you_mean(name, names_of(solvers))))
  end
  if not rest:find "[^ ]" then rest = "{}" end
  local table_of = rest:find "^ ?{" and rest:find "} ?$" and not rest:find "[^%w%s%.%+%-%*/%^%(%)_=,\"'{}]"
    and compile(rest, place, "--solver")
  if not table_of then
    native.refuse(("%s is not a solver as a deck writes it, as in --solver '%s{ %s = %s }'"):format(place, name,
      entry.arguments[1][1], tostring(entry.arguments[1].default)))
  end
  local named = setmetatable({ path = "--solver " .. name }, { __index = entry })
  return native.make("solver." .. name, entry.makes, check.call(named, line, table_of()), line)
end

return { parameter = parameter, quantity = quantity, solver = solver }
