// How Sphinx's search ranks: pages of the manual come before what the program prints, and that before evidence and code.
var Scorer = {
  score: ([name, , , , score]) => {
    const kind = name.split("/")[0];
    const order = ["evidence", "code", "overview", "reference", "gallery", "explanation", "how-to", "tutorials"];
    return score + (name.endsWith("index") ? 0 : 10 * Math.min(order.indexOf(kind), 6));
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 20,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
