-- Arithmetic of a deck's objects: histories and functions of time are scaled, added and asked for their value; what else
-- is written with an operator is told what would do.
local native = ...
local describe = native.module("check").describe

local function fail(text, hint)
  native.fail(native.line(), text .. (hint and "\n    " .. hint or ""))
end

local function is_history(value) return type(value) == "function" or native.kind(value) == "history" end
local function is_term(value) return is_history(value) or type(value) == "number" end

local cures = {
  series = "take a number of it: .max, .min, .last, [i] or :at(t)",
  data = "take a number of it, as in result[output].normal.max",
  result = "take an output of it: result[output]",
  problem = "its numbers are those of its result: problem{ ... }:run{}",
}

-- Of two operands, the one that stands in the way.
local function refuse(what, a, b)
  local wrong = a
  if is_term(a) then wrong = b end
  if is_term(a) and is_term(b) then wrong = is_history(a) and a or b end
  fail(("%s cannot be %s"):format(describe(wrong), what), cures[native.kind(wrong) or ""])
end

local function as_function(operator)
  return ("only numbers scale a history; of two write function(t) return a(t) %s b(t) end"):format(operator)
end

local function scaled(history, factor)
  local made = native.combine("scaled", history, factor, native.line())
  return made
end

local function sum(a, b)
  if not is_history(a) then a, b = b, a end
  local made = native.combine("sum", a, b, native.line())
  return made
end

local operators = {}

function operators.__mul(a, b)
  if is_history(a) and type(b) == "number" then return (scaled(a, b)) end
  if type(a) == "number" and is_history(b) then return (scaled(b, a)) end
  if is_history(a) and is_history(b) then fail("a history times a history", as_function "*") end
  refuse("multiplied", a, b)
end

function operators.__div(a, b)
  if is_history(a) and type(b) == "number" then return (scaled(a, 1 / b)) end
  if is_term(a) and is_history(b) then fail("something divided by a history", as_function "/") end
  refuse("divided", a, b)
end

function operators.__add(a, b)
  if is_term(a) and is_term(b) then return (sum(a, b)) end
  refuse("added", a, b)
end

function operators.__sub(a, b)
  if not is_term(a) or not is_term(b) then refuse("subtracted", a, b) end
  local negative
  if type(b) == "number" then negative = -b else negative = scaled(b, -1) end
  return (sum(a, negative))
end

function operators.__unm(a)
  if is_history(a) then return (scaled(a, -1)) end
  refuse("negated", a, a)
end

for event, what in pairs { __pow = "raised to a power", __mod = "divided", __idiv = "divided" } do
  operators[event] = function(a, b)
    if is_term(a) and is_term(b) then
      fail(("a history cannot be %s"):format(what), "write a function(t): a history answers its value at t, as in signal(t)^2")
    end
    refuse(what, a, b)
  end
end

local of_functions = {}
for event, operator in pairs(operators) do of_functions[event] = operator end

function operators.__concat(a, b)
  local wrong = native.kind(a) and a or b
  fail(("%s cannot be joined to a text"):format(describe(wrong)), cures[native.kind(wrong)])
end

local function compare(a, b)
  local wrong = native.kind(a) and a or b
  fail(("%s cannot be compared"):format(describe(wrong)), cures[native.kind(wrong)])
end
operators.__lt, operators.__le = compare, compare

local called = {
  substructure = 'a face is part:face "group"',
  problem = "it is run by problem{ ... }:run{}",
}

-- signal(t). Also from inside a function of time, where nothing can be declared.
function operators.__call(self, t, ...)
  if native.kind(self) ~= "history" then
    fail(("%s is not called"):format(describe(self)), called[native.kind(self)])
  end
  if type(t) ~= "number" or select("#", ...) > 0 then fail("a history is asked for its value at a time: signal(t)") end
  return (native.value_of(self, t))
end

return { of_objects = operators, of_functions = of_functions }
