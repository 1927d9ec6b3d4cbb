// Reads names, labels and meanings of faults and metrics from the page.

function read_words() {
  try {
    return JSON.parse(document.getElementById("report-words").textContent);
  } catch {
    return { faults: [], metrics: [], columns_of_studies: [] }; // a page without data says so elsewhere
  }
}
export const words = read_words();

const fault_of = Object.fromEntries(words.faults.map((fault) => [fault.name, fault]));

/** The names of the faults in the order of legends. */
export const fault_order = words.faults.map(({ name }) => name);
/** The faults among names, in the order of legends. */
export const faults_in = (names) => {
  const present = new Set(names);
  return fault_order.filter((fault) => present.has(fault));
};
// A catalogue may hold any text as a fault.
export const fault_name = (fault) => fault_of[fault]?.label ?? fault;
export const fault_words = (fault) => fault_of[fault]?.meaning ?? fault;
export const fault_colour = (fault) => `var(--${fault.replaceAll("_", "-")})`;
